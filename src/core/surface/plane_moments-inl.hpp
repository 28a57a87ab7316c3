// SPDX-License-Identifier: BSD-3-Clause
// Planes through the neighbourhoods of several points, one in each lane; for inclusion by kernels that Highway compiles
// once for each target.
#if defined(SKS_PLANE_MOMENTS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SKS_PLANE_MOMENTS_INL
#undef SKS_PLANE_MOMENTS_INL
#else
#define SKS_PLANE_MOMENTS_INL
#endif

#include <limits>

#include <hwy/highway.h>

#include "core/surface/plane_fit.hpp"
#include "core/surface/smallest_eigenvector-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace sks {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t max_lanes = PointGrid::simd_padding;
using Points = hn::CappedTag<float, max_lanes>;

/// Sums over the neighbours of each point, relative to it.
struct Moments {
  enum { count, x, y, z, xx, xy, xz, yy, yz, zz, size };
  float sums[size][max_lanes];
};

/// Unit normals and how well each is determined.
struct Fits {
  float x[max_lanes], y[max_lanes], z[max_lanes], certainty[max_lanes];
};

/// Forms the moments of a vector of points.
class MomentSums {
public:
  using V = hn::Vec<Points>;

  MomentSums(V x, V y, V z, float radius) : cx_(x), cy_(y), cz_(z), limit_(hn::Set(d_, radius * radius)) {}

  /// One more candidate for each of the points; NaN is none.
  HWY_INLINE void add(V px, V py, V pz) {
    V x = hn::Sub(px, cx_), y = hn::Sub(py, cy_), z = hn::Sub(pz, cz_);
    const V squared = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
    const auto inside = hn::Le(squared, limit_);
    x = hn::IfThenElseZero(inside, x);
    y = hn::IfThenElseZero(inside, y);
    z = hn::IfThenElseZero(inside, z);
    n_ = hn::Sub(n_, hn::VecFromMask(di_, hn::RebindMask(di_, inside)));  // all bits of a mask are -1
    sx_ = hn::Add(sx_, x);
    sy_ = hn::Add(sy_, y);
    sz_ = hn::Add(sz_, z);
    xx_ = hn::MulAdd(x, x, xx_);
    xy_ = hn::MulAdd(x, y, xy_);
    xz_ = hn::MulAdd(x, z, xz_);
    yy_ = hn::MulAdd(y, y, yy_);
    yz_ = hn::MulAdd(y, z, yz_);
    zz_ = hn::MulAdd(z, z, zz_);
  }

  void store(Moments& moments) const {
    float* out = moments.sums[0];
    for (const V& sum : {hn::ConvertTo(d_, n_), sx_, sy_, sz_, xx_, xy_, xz_, yy_, yz_, zz_}) {
      hn::StoreU(sum, d_, out);
      out += max_lanes;
    }
  }

private:
  Points d_;
  hn::RebindToSigned<Points> di_;
  V cx_, cy_, cz_, limit_;
  hn::Vec<hn::RebindToSigned<Points>> n_ = hn::Zero(di_);
  V sx_ = hn::Zero(d_), sy_ = sx_, sz_ = sx_;
  V xx_ = sx_, xy_ = sx_, xz_ = sx_, yy_ = sx_, yz_ = sx_, zz_ = sx_;
};

/// Covariances of some points from their moments, in double precision, divided by their traces.
template <class D>
HWY_INLINE SymmetricMatrices<hn::Vec<D>> covariances(D d, const Moments& moments, std::size_t first) {
  const hn::Rebind<float, D> df;
  const auto load = [&](int k) { return hn::PromoteTo(d, hn::LoadU(df, &moments.sums[k][first])); };
  const auto weight = hn::Div(hn::Set(d, 1.0), load(Moments::count));
  const auto mx = hn::Mul(load(Moments::x), weight), my = hn::Mul(load(Moments::y), weight),
             mz = hn::Mul(load(Moments::z), weight);
  const auto covariance = [&](int k, auto a, auto b) { return hn::MulSub(load(k), weight, hn::Mul(a, b)); };
  SymmetricMatrices<hn::Vec<D>> m;
  m.xx = covariance(Moments::xx, mx, mx);
  m.xy = covariance(Moments::xy, mx, my);
  m.xz = covariance(Moments::xz, mx, mz);
  m.yy = covariance(Moments::yy, my, my);
  m.yz = covariance(Moments::yz, my, mz);
  m.zz = covariance(Moments::zz, mz, mz);
  divideByTrace(d, m);
  return m;
}

/// Fits of the points of a vector from their moments.
inline void solve(const Moments& moments, Fits& fits) {
  const hn::CappedTag<double, max_lanes / 2> d;
  const hn::Rebind<float, decltype(d)> df;
  using V = hn::Vec<decltype(d)>;
  const auto store = [&](const SymmetricMatrices<V>& m, V eigenvalue, std::size_t i) {
    V x = hn::Zero(d), y = x, z = x;
    const V certainty = eigenvectors(d, m, eigenvalue, x, y, z);
    hn::StoreU(hn::DemoteTo(df, x), df, &fits.x[i]);
    hn::StoreU(hn::DemoteTo(df, y), df, &fits.y[i]);
    hn::StoreU(hn::DemoteTo(df, z), df, &fits.z[i]);
    hn::StoreU(hn::DemoteTo(df, certainty), df, &fits.certainty[i]);
  };
  const std::size_t half = hn::Lanes(d);
  for (std::size_t i = 0; i < hn::Lanes(Points()); i += 2 * half) {
    const auto m0 = covariances(d, moments, i), m1 = covariances(d, moments, i + half);
    V root0, root1;
    smallestEigenvalues(d, m0, m1, root0, root1);
    store(m0, root0, i);
    store(m1, root1, i + half);
  }
}

inline Eigen::Matrix3d covariance(const Moments& moments, std::size_t i) {
  const auto sum = [&](int k) { return double(moments.sums[k][i]); };
  const double n = sum(Moments::count);
  const Eigen::Vector3d mean = Eigen::Vector3d(sum(Moments::x), sum(Moments::y), sum(Moments::z)) / n;
  Eigen::Matrix3d scatter;
  scatter << sum(Moments::xx), sum(Moments::xy), sum(Moments::xz), sum(Moments::xy), sum(Moments::yy), sum(Moments::yz),
      sum(Moments::xz), sum(Moments::yz), sum(Moments::zz);
  return scatter / n - mean * mean.transpose();
}

/// NaN where there are fewer than `min_neighbors`.
inline Eigen::Vector3f normalOf(const Moments& moments, const Fits& fits, std::size_t i, int min_neighbors) {
  if (moments.sums[Moments::count][i] < float(min_neighbors)) {
    return Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
  }
  if (!(fits.certainty[i] > 1e-12f)) return smallestEigenvector(covariance(moments, i));
  return {fits.x[i], fits.y[i], fits.z[i]};
}

}  // namespace HWY_NAMESPACE
}  // namespace sks
HWY_AFTER_NAMESPACE();

#endif
