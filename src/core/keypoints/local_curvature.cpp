// SPDX-License-Identifier: BSD-3-Clause
#include "core/keypoints/local_curvature.hpp"

#include <algorithm>

#include <Eigen/Geometry>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/keypoints/local_curvature.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sks {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Sums over the neighbours that have a normal: count, a, b, aa, ab, bb; a and b are the normal's parts along u and v.
void sumTangents(const Surface& surface, const float* center, const float* u, const float* v, float radius,
                 const std::vector<PointGrid::Run>& runs, double* sums) {
  const hn::CappedTag<float, PointGrid::simd_padding> d;
  const auto set = [&](float value) { return hn::Set(d, value); };
  const auto limit = set(radius * radius);
  auto n = hn::Zero(d), sa = n, sb = n, aa = n, ab = n, bb = n;
  for (const PointGrid::Run run : runs) {
    for (std::size_t i = run.begin; i < run.end; i += hn::Lanes(d)) {
      const auto x = hn::Sub(hn::LoadU(d, &surface.x[i]), set(center[0]));
      const auto y = hn::Sub(hn::LoadU(d, &surface.y[i]), set(center[1]));
      const auto z = hn::Sub(hn::LoadU(d, &surface.z[i]), set(center[2]));
      const auto squared = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
      const auto nx = hn::LoadU(d, &surface.nx[i]), ny = hn::LoadU(d, &surface.ny[i]),
                 nz = hn::LoadU(d, &surface.nz[i]);
      const auto near = hn::And(hn::Le(squared, limit), hn::FirstN(d, run.end - i));
      const auto used = hn::And(near, hn::Eq(nx, nx));
      const auto along = [&](const float* axis) {
        const auto sum = hn::MulAdd(set(axis[0]), nx, hn::MulAdd(set(axis[1]), ny, hn::Mul(set(axis[2]), nz)));
        return hn::IfThenElseZero(used, sum);
      };
      const auto a = along(u), b = along(v);
      n = hn::Add(n, hn::IfThenElseZero(used, set(1.0f)));
      sa = hn::Add(sa, a);
      sb = hn::Add(sb, b);
      aa = hn::MulAdd(a, a, aa);
      ab = hn::MulAdd(a, b, ab);
      bb = hn::MulAdd(b, b, bb);
    }
  }
  for (const auto& sum : {n, sa, sb, aa, ab, bb}) *sums++ = double(hn::GetLane(hn::SumOfLanes(d, sum)));
}

}  // namespace HWY_NAMESPACE
}  // namespace sks
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sks {

HWY_EXPORT(sumTangents);

float gaussianCurvature(const Surface& surface, const Eigen::Vector3f& center, const Eigen::Vector3f& normal,
                        float radius, const std::vector<PointGrid::Run>& runs) {
  const Eigen::Vector3f u = normal.unitOrthogonal(), v = normal.cross(u);
  double sums[6];
  HWY_DYNAMIC_DISPATCH(sumTangents)(surface, center.data(), u.data(), v.data(), radius, runs, sums);
  const double n = sums[0];
  if (n < 3) return 0;
  const double a = sums[1] / n, b = sums[2] / n;
  const double aa = sums[3] / n - a * a, ab = sums[4] / n - a * b, bb = sums[5] / n - b * b;
  return float(std::max(0.0, aa * bb - ab * ab));
}

}  // namespace sks
#endif
