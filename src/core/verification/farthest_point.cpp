// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/farthest_point.hpp"

#include <cstddef>
#include <cstdint>

#include <sks_detector/stages/point_grid.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/verification/farthest_point.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sks {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Number of the point. @param size a multiple of PointGrid::simd_padding
std::size_t farthestImpl(const float* x, const float* y, const float* z, std::size_t size, const float* direction) {
  const hn::CappedTag<float, PointGrid::simd_padding> d;
  const hn::RebindToSigned<decltype(d)> di;
  const auto dx = hn::Set(d, direction[0]), dy = hn::Set(d, direction[1]), dz = hn::Set(d, direction[2]);
  const auto heightAt = [&](std::size_t i) {
    return hn::MulAdd(dx, hn::LoadU(d, x + i), hn::MulAdd(dy, hn::LoadU(d, y + i), hn::Mul(dz, hn::LoadU(d, z + i))));
  };
  auto highest = heightAt(0);
  auto block = hn::Zero(di);  // of the highest in each lane
  for (std::size_t i = hn::Lanes(d); i < size; i += hn::Lanes(d)) {
    const auto height = heightAt(i);
    const auto above = hn::Gt(height, highest);
    highest = hn::IfThenElse(above, height, highest);
    block = hn::IfThenElse(hn::RebindMask(di, above), hn::Set(di, std::int32_t(i)), block);
  }
  HWY_ALIGN float heights[PointGrid::simd_padding];
  HWY_ALIGN std::int32_t blocks[PointGrid::simd_padding];
  hn::Store(highest, d, heights);
  hn::Store(block, di, blocks);
  std::size_t best = 0;
  for (std::size_t lane = 1; lane < hn::Lanes(d); ++lane) {
    if (heights[lane] > heights[best]) best = lane;
  }
  return std::size_t(blocks[best]) + best;
}

}  // namespace HWY_NAMESPACE
}  // namespace sks
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sks {

HWY_EXPORT(farthestImpl);

FarthestPoint::FarthestPoint(const std::vector<Eigen::Vector3f>& points) {
  const std::size_t padding = PointGrid::simd_padding, size = (points.size() + padding - 1) / padding * padding;
  const auto axis = [&](int k) {
    std::vector<float> values(size, points.back()[k]);
    for (std::size_t i = 0; i < points.size(); ++i) values[i] = points[i][k];
    return values;
  };
  x_ = axis(0), y_ = axis(1), z_ = axis(2);
}

Eigen::Vector3f FarthestPoint::along(const Eigen::Vector3f& direction) const {
  const std::size_t i =
      HWY_DYNAMIC_DISPATCH(farthestImpl)(x_.data(), y_.data(), z_.data(), x_.size(), direction.data());
  return {x_[i], y_[i], z_[i]};
}

}  // namespace sks
#endif
