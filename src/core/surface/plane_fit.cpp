// SPDX-License-Identifier: BSD-3-Clause
#include "core/surface/plane_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/surface/plane_fit.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sks {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Sums over the neighbours of a centre, relative to it: count, x, y, z, xx, xy, xz, yy, yz, zz.
void sumMoments(const PointGrid& grid, const float* center, float radius, const PointGrid::Run* runs,
                std::size_t run_count, double* moments) {
  const hn::ScalableTag<float> d;
  const auto cx = hn::Set(d, center[0]), cy = hn::Set(d, center[1]), cz = hn::Set(d, center[2]);
  const auto limit = hn::Set(d, radius * radius), one = hn::Set(d, 1.0f), zero = hn::Zero(d);
  auto n = zero, sx = zero, sy = zero, sz = zero;
  auto xx = zero, xy = zero, xz = zero, yy = zero, yz = zero, zz = zero;
  for (std::size_t r = 0; r < run_count; ++r) {
    for (std::size_t i = runs[r].begin; i < runs[r].end; i += hn::Lanes(d)) {
      auto x = hn::Sub(hn::LoadU(d, &grid.x[i]), cx);
      auto y = hn::Sub(hn::LoadU(d, &grid.y[i]), cy);
      auto z = hn::Sub(hn::LoadU(d, &grid.z[i]), cz);
      const auto squared = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
      const auto inside = hn::And(hn::Le(squared, limit), hn::FirstN(d, runs[r].end - i));
      x = hn::IfThenElseZero(inside, x);
      y = hn::IfThenElseZero(inside, y);
      z = hn::IfThenElseZero(inside, z);
      n = hn::Add(n, hn::IfThenElseZero(inside, one));
      sx = hn::Add(sx, x);
      sy = hn::Add(sy, y);
      sz = hn::Add(sz, z);
      xx = hn::MulAdd(x, x, xx);
      xy = hn::MulAdd(x, y, xy);
      xz = hn::MulAdd(x, z, xz);
      yy = hn::MulAdd(y, y, yy);
      yz = hn::MulAdd(y, z, yz);
      zz = hn::MulAdd(z, z, zz);
    }
  }
  const auto sum = [&](auto v) { return double(hn::GetLane(hn::SumOfLanes(d, v))); };
  const double all[] = {sum(n), sum(sx), sum(sy), sum(sz), sum(xx), sum(xy), sum(xz), sum(yy), sum(yz), sum(zz)};
  std::copy(std::begin(all), std::end(all), moments);
}

}  // namespace HWY_NAMESPACE
}  // namespace sks
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sks {

HWY_EXPORT(sumMoments);

Eigen::Vector3f smallestEigenvector(const Eigen::Matrix3d& matrix) {
  const double trace = matrix.trace();
  if (trace > 0) {
    const Eigen::Matrix3d m = matrix / trace;
    const double minors = m(0, 0) * m(1, 1) - m(1, 0) * m(1, 0) + m(0, 0) * m(2, 2) - m(2, 0) * m(2, 0) +
                          m(1, 1) * m(2, 2) - m(2, 1) * m(2, 1);
    const double determinant = m.determinant();
    // Newton's method on the characteristic polynomial climbs from 0 to the smallest root; a flat patch needs few
    // steps.
    double root = 0;
    for (int i = 0; i < 30; ++i) {
      const double slope = (3 * root - 2) * root + minors;
      if (!(slope > 0)) break;
      const double step = (((root - 1) * root + minors) * root - determinant) / slope;
      root -= step;
      if (std::abs(step) < 1e-14) break;
    }
    const Eigen::Matrix3d shifted = m - root * Eigen::Matrix3d::Identity();
    const Eigen::Vector3d candidates[] = {shifted.col(0).cross(shifted.col(1)), shifted.col(0).cross(shifted.col(2)),
                                          shifted.col(1).cross(shifted.col(2))};
    const Eigen::Vector3d& longest =
        *std::max_element(std::begin(candidates), std::end(candidates),
                          [](const auto& a, const auto& b) { return a.squaredNorm() < b.squaredNorm(); });
    if (longest.norm() > 1e-6) return longest.normalized().cast<float>();
  }
  // Points along a line, or in a ball, determine no plane: any answer is as good.
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(matrix).eigenvectors().col(0).cast<float>();
}

Eigen::Vector3f fitPlane(const PointGrid& grid, const Eigen::Vector3f& center, float radius, int min_neighbors,
                         const std::vector<PointGrid::Run>& runs) {
  double m[10];
  HWY_DYNAMIC_DISPATCH(sumMoments)(grid, center.data(), radius, runs.data(), runs.size(), m);
  if (m[0] < min_neighbors) return Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
  const Eigen::Vector3d mean = Eigen::Vector3d(m[1], m[2], m[3]) / m[0];
  Eigen::Matrix3d scatter;
  scatter << m[4], m[5], m[6], m[5], m[7], m[8], m[6], m[8], m[9];
  return smallestEigenvector(scatter / m[0] - mean * mean.transpose());
}

}  // namespace sks
#endif
