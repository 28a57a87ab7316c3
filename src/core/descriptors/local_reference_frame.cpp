// SPDX-License-Identifier: BSD-3-Clause
#include "core/descriptors/local_reference_frame.hpp"

#include <algorithm>
#include <iterator>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/descriptors/local_reference_frame.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sks {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Neighbors = hn::CappedTag<float, PointGrid::simd_padding>;

/// Sums of the weights w = radius - distance, and of w xx, w xy, w xz, w yy, w yz, w zz.
void weightedScatter(const Neighborhood& n, float radius, double* sums) {
  const Neighbors d;
  const auto reach = hn::Set(d, radius);
  auto weights = hn::Zero(d), xx = weights, xy = weights, xz = weights, yy = weights, yz = weights, zz = weights;
  for (std::size_t i = 0; i < n.size; i += hn::Lanes(d)) {
    const auto used = hn::FirstN(d, n.size - i);
    const auto w = hn::IfThenElseZero(used, hn::Sub(reach, hn::LoadU(d, n.distance.data() + i)));
    const auto x = hn::IfThenElseZero(used, hn::LoadU(d, n.x.data() + i));
    const auto y = hn::IfThenElseZero(used, hn::LoadU(d, n.y.data() + i));
    const auto z = hn::IfThenElseZero(used, hn::LoadU(d, n.z.data() + i));
    const auto wx = hn::Mul(w, x), wy = hn::Mul(w, y), wz = hn::Mul(w, z);
    weights = hn::Add(weights, w);
    xx = hn::MulAdd(wx, x, xx);
    xy = hn::MulAdd(wx, y, xy);
    xz = hn::MulAdd(wx, z, xz);
    yy = hn::MulAdd(wy, y, yy);
    yz = hn::MulAdd(wy, z, yz);
    zz = hn::MulAdd(wz, z, zz);
  }
  const auto sum = [&](auto v) { return double(hn::GetLane(hn::SumOfLanes(d, v))); };
  const double all[] = {sum(weights), sum(xx), sum(xy), sum(xz), sum(yy), sum(yz), sum(zz)};
  std::copy(std::begin(all), std::end(all), sums);
}

/// For each of two axes (a, b) by how many more neighbours lie on its side than on the other, and their sum along it.
void balance(const Neighborhood& n, const float* a, const float* b, int* more, float* sums) {
  const Neighbors d;
  const auto zero = hn::Zero(d);
  auto sum_a = zero, sum_b = zero;
  std::size_t side_a = 0, side_b = 0;
  for (std::size_t i = 0; i < n.size; i += hn::Lanes(d)) {
    const auto used = hn::FirstN(d, n.size - i);
    const auto x = hn::LoadU(d, n.x.data() + i), y = hn::LoadU(d, n.y.data() + i), z = hn::LoadU(d, n.z.data() + i);
    const auto along = [&](const float* axis) {
      return hn::MulAdd(hn::Set(d, axis[0]), x, hn::MulAdd(hn::Set(d, axis[1]), y, hn::Mul(hn::Set(d, axis[2]), z)));
    };
    const auto along_a = along(a), along_b = along(b);
    side_a += hn::CountTrue(d, hn::And(used, hn::Ge(along_a, zero)));
    side_b += hn::CountTrue(d, hn::And(used, hn::Ge(along_b, zero)));
    sum_a = hn::Add(sum_a, hn::IfThenElseZero(used, along_a));
    sum_b = hn::Add(sum_b, hn::IfThenElseZero(used, along_b));
  }
  more[0] = 2 * int(side_a) - int(n.size);
  more[1] = 2 * int(side_b) - int(n.size);
  sums[0] = hn::GetLane(hn::SumOfLanes(d, sum_a));
  sums[1] = hn::GetLane(hn::SumOfLanes(d, sum_b));
}

}  // namespace HWY_NAMESPACE
}  // namespace sks
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sks {

HWY_EXPORT(weightedScatter);
HWY_EXPORT(balance);

bool localReferenceFrame(const Neighborhood& n, float radius, Eigen::Matrix3f& frame) {
  double m[7];
  HWY_DYNAMIC_DISPATCH(weightedScatter)(n, radius, m);
  if (!(m[0] > 0)) return false;
  Eigen::Matrix3d covariance;
  covariance << m[1], m[2], m[3], m[2], m[4], m[5], m[3], m[5], m[6];
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance / m[0]);
  if (!(solver.eigenvalues()[2] > 0)) return false;

  // Both axes point to the side on which most neighbours lie; at a tie to the side of their sum.
  Eigen::Vector3f x = solver.eigenvectors().col(2).cast<float>(), z = solver.eigenvectors().col(0).cast<float>();
  int more[2];
  float sums[2];
  HWY_DYNAMIC_DISPATCH(balance)(n, x.data(), z.data(), more, sums);
  if (more[0] < 0 || (more[0] == 0 && sums[0] < 0)) x = -x;
  if (more[1] < 0 || (more[1] == 0 && sums[1] < 0)) z = -z;
  frame.row(0) = x;
  frame.row(1) = z.cross(x);
  frame.row(2) = z;
  return frame.allFinite();
}

}  // namespace sks
#endif
