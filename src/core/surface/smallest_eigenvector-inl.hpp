// SPDX-License-Identifier: BSD-3-Clause
// Smallest eigenvectors of many symmetric 3 x 3 matrices at once; for inclusion by kernels that Highway compiles once
// for each target.
#if defined(SKS_SMALLEST_EIGENVECTOR_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SKS_SMALLEST_EIGENVECTOR_INL
#undef SKS_SMALLEST_EIGENVECTOR_INL
#else
#define SKS_SMALLEST_EIGENVECTOR_INL
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sks {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// One symmetric matrix in each lane.
template <class V>
struct SymmetricMatrices {
  V xx, xy, xz, yy, yz, zz;
};

/// Characteristic polynomials of matrices with trace 1, no eigenvalue negative: those of sums of squares.
template <class D, class V>
class Characteristic {
public:
  HWY_INLINE Characteristic(D d, const SymmetricMatrices<V>& m)
      : d_(d),
        minors_(hn::Sub(hn::MulAdd(m.xx, m.yy, hn::MulAdd(m.xx, m.zz, hn::Mul(m.yy, m.zz))),
                        hn::MulAdd(m.xy, m.xy, hn::MulAdd(m.xz, m.xz, hn::Mul(m.yz, m.yz))))) {
    const V yz = hn::Sub(hn::Mul(m.yy, m.zz), hn::Mul(m.yz, m.yz));
    const V xz = hn::Sub(hn::Mul(m.xy, m.zz), hn::Mul(m.yz, m.xz));
    const V xy = hn::Sub(hn::Mul(m.xy, m.yz), hn::Mul(m.yy, m.xz));
    determinant_ = hn::MulAdd(m.xz, xy, hn::NegMulAdd(m.xy, xz, hn::Mul(m.xx, yz)));
  }

  /// A step of Newton's method, which climbs from 0 to the smallest root; 0 where the last one was within the
  /// tolerance.
  HWY_INLINE V step(V root, V last) const {
    const V slope = hn::MulAdd(hn::MulSub(hn::Set(d_, 3.0), root, hn::Set(d_, 2.0)), root, minors_);
    const V value = hn::MulSub(hn::MulAdd(hn::Sub(root, hn::Set(d_, 1.0)), root, minors_), root, determinant_);
    const auto moving = hn::And(hn::Gt(slope, hn::Zero(d_)), hn::Gt(hn::Abs(last), tolerance()));
    return hn::IfThenElseZero(moving, hn::Div(value, slope));
  }

  HWY_INLINE bool converged(V step) const { return hn::AllFalse(d_, hn::Gt(hn::Abs(step), tolerance())); }

private:
  HWY_INLINE V tolerance() const { return hn::Set(d_, 1e-9); }  // of steps: what is left is about its square

  D d_;
  V minors_, determinant_;
};

/// Smallest eigenvalues of two vectors of matrices: while one waits for a division, the other goes on. A flat patch
/// needs few steps.
template <class D, class V>
HWY_INLINE void smallestEigenvalues(D d, const SymmetricMatrices<V>& m0, const SymmetricMatrices<V>& m1, V& root0,
                                    V& root1) {
  const Characteristic<D, V> p0(d, m0), p1(d, m1);
  V step0 = hn::Set(d, 1.0), step1 = step0;
  root0 = root1 = hn::Zero(d);
  for (int i = 0; i < 30; ++i) {
    step0 = p0.step(root0, step0);
    step1 = p1.step(root1, step1);
    root0 = hn::Sub(root0, step0);
    root1 = hn::Sub(root1, step1);
    if (p0.converged(step0) && p1.converged(step1)) break;
  }
}

template <class D, class V>
HWY_INLINE void divideByTrace(D d, SymmetricMatrices<V>& m) {
  const V scale = hn::Div(hn::Set(d, 1.0), hn::Add(m.xx, hn::Add(m.yy, m.zz)));
  for (V* entry : {&m.xx, &m.xy, &m.xz, &m.yy, &m.yz, &m.zz}) *entry = hn::Mul(*entry, scale);
}

/// Unit eigenvectors (x, y, z) to eigenvalues. @return how well each is determined: not at all (below 1e-12, or NaN)
/// for points along a line, or in a ball
template <class D, class V>
HWY_INLINE V eigenvectors(D d, SymmetricMatrices<V> m, V eigenvalue, V& x, V& y, V& z) {
  for (V* entry : {&m.xx, &m.yy, &m.zz}) *entry = hn::Sub(*entry, eigenvalue);

  // The shifted matrix has rank 2: its columns span the plane, and the longest of their products is the most exact.
  V longest = hn::Set(d, -1.0);
  const auto consider = [&](V ax, V ay, V az, V bx, V by, V bz) {
    const V cx = hn::Sub(hn::Mul(ay, bz), hn::Mul(az, by));
    const V cy = hn::Sub(hn::Mul(az, bx), hn::Mul(ax, bz));
    const V cz = hn::Sub(hn::Mul(ax, by), hn::Mul(ay, bx));
    const V squared = hn::MulAdd(cx, cx, hn::MulAdd(cy, cy, hn::Mul(cz, cz)));
    const auto better = hn::Gt(squared, longest);
    longest = hn::IfThenElse(better, squared, longest);
    x = hn::IfThenElse(better, cx, x);
    y = hn::IfThenElse(better, cy, y);
    z = hn::IfThenElse(better, cz, z);
  };
  consider(m.xx, m.xy, m.xz, m.xy, m.yy, m.yz);
  consider(m.xx, m.xy, m.xz, m.xz, m.yz, m.zz);
  consider(m.xy, m.yy, m.yz, m.xz, m.yz, m.zz);
  const V length = hn::Sqrt(longest);
  for (V* axis : {&x, &y, &z}) *axis = hn::Div(*axis, length);
  return longest;
}

}  // namespace HWY_NAMESPACE
}  // namespace sks
HWY_AFTER_NAMESPACE();

#endif
