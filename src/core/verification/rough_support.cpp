// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/rough_support.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/verification/color_agreement.hpp"
#include "core/verification/surface_sample.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/verification/rough_support.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "core/verification/ray_lanes-inl.hpp"

#ifndef SKS_ROUGH_SUPPORT_ONCE
#define SKS_ROUGH_SUPPORT_ONCE
namespace sks {

/// What the sensor saw in the direction of a placed point of the surface.
enum class RoughSight : int { nothing_to_say, unmeasured, missed, confirmed };

struct RoughLimits {
  float distance = 0.015f;  // [m] rough poses are that far off
  float agreement = 0.7f;   // cosine, about 45 degrees
  float occlusion = 0.02f;  // [m]
};

}  // namespace sks
#endif

HWY_BEFORE_NAMESPACE();
namespace sks {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// @param sights,cells of each point of the sample; both are padded as it is
void lookRoughlyImpl(const SurfaceSample& sample, const RangeImage& image, const RigidRows& T, std::int32_t* sights,
                     std::int32_t* cells) {
  const Lanes d;
  const hn::RebindToSigned<Lanes> di;
  const RoughLimits limits;
  const auto set = [&](float value) { return hn::Set(d, value); };
  const auto sight = [&](RoughSight s) { return hn::Set(di, std::int32_t(s)); };
  const float* values = &image.cells().data()->x;
  for (std::size_t i = 0; i < sample.size; i += hn::Lanes(d)) {
    const auto load = [&](const std::vector<float>& v) { return hn::LoadU(d, v.data() + i); };
    const Vector3 place = mapped(T, {load(sample.x), load(sample.y), load(sample.z)}, 1);
    const Vector3 normal = mapped(T, {load(sample.nx), load(sample.ny), load(sample.nz)}, 0);
    const Vector3 ray = repeat(image.projection().origin) - place;
    const auto range = hn::Sqrt(ray.dot(ray));
    const auto facing = hn::Gt(normal.dot(ray), hn::Mul(set(grazing), range));
    hn::Mask<Lanes> seen;
    const auto cell = cellsOf(image.projection(), place, seen);
    const auto at = hn::ShiftLeft<3>(cell);
    const auto look = [&](int k) { return hn::GatherIndex(d, values + k, at); };
    const Vector3 found{look(0), look(1), look(2)}, found_normal{look(3), look(4), look(5)};
    const Vector3 apart = found - place;
    const auto confirmed = hn::And(seen, hn::And(hn::Gt(normal.dot(found_normal), set(limits.agreement)),
                                                 hn::Lt(apart.dot(apart), set(limits.distance * limits.distance))));
    const auto nearest = look(6), farthest = look(7);
    const auto measured = hn::And(seen, hn::Ge(farthest, hn::Zero(d)));
    const auto behind = hn::Gt(range, hn::Add(farthest, set(limits.occlusion)));
    const auto before = hn::Lt(range, hn::Sub(nearest, set(limits.occlusion)));
    const auto hidden = hn::And(behind, hn::Not(before));
    const auto choose = [&](auto mask, auto yes, auto no) { return hn::IfThenElse(hn::RebindMask(di, mask), yes, no); };
    auto result = choose(hidden, sight(RoughSight::nothing_to_say), sight(RoughSight::missed));
    result = choose(measured, result, sight(RoughSight::unmeasured));
    result = choose(confirmed, sight(RoughSight::confirmed), result);
    hn::StoreU(choose(facing, result, sight(RoughSight::nothing_to_say)), di, sights + i);
    hn::StoreU(cell, di, cells + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace sks
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sks {

HWY_EXPORT(lookRoughlyImpl);

namespace {

constexpr std::size_t rough_points = 80, most_points = 2 * rough_points;
constexpr float rough_color_slack = 1.5f;  // of the tolerance: prints are off by as much as the pose

/// Between `rough_points` and `most_points` are taken.
std::size_t roughStride(const TrainingView& view) {
  return std::max<std::size_t>(1, view.surface_points.size() / rough_points);
}

}  // namespace

RoughSurface::RoughSurface(const TrainingView& view) {
  SurfaceWeigher weigher(view);
  const std::size_t stride = roughStride(view);
  sample.take(view, stride);
  for (std::size_t i = 0; i < view.surface_points.size(); i += stride) {
    const SurfaceWeight weight = weigher.at(i);
    shape.push_back(weight.shape);
    shape_and_color.push_back(weight.shape_and_color);
    if (!view.surface_colors.empty()) colors.push_back(view.surface_colors[i]);
  }
}

double RoughSupport::scoreWithoutVotes() const {
  constexpr int fewest = 6;
  constexpr double prior = 0.2;  // as of votes
  return points < fewest ? 0 : supported / (visible + prior) * std::sqrt(supported);
}

RoughSupport roughSupport(const RoughSurface& surface, const SceneView& scene, const Eigen::Isometry3d& T_scene_model) {
  RoughSupport support;
  const bool compares_color = scene.color_tolerance > 0 && !surface.colors.empty();
  const std::vector<float>& weights = compares_color ? surface.shape_and_color : surface.shape;
  const float color_tolerance = rough_color_slack * scene.color_tolerance;
  if (scene.range_image.cells().empty()) return support;
  std::array<std::int32_t, most_points + PointGrid::simd_padding> sights, cells;
  const RigidRows T = T_scene_model.matrix().topRows<3>().cast<float>();
  HWY_DYNAMIC_DISPATCH(lookRoughlyImpl)(surface.sample, scene.range_image, T, sights.data(), cells.data());
  for (std::size_t i = 0; i < surface.sample.size; ++i) {
    const RoughSight sight = RoughSight(sights[i]);
    if (sight == RoughSight::nothing_to_say) continue;
    support.visible += sight == RoughSight::unmeasured ? unmeasured * weights[i] : double(weights[i]);
    if (sight != RoughSight::confirmed) continue;
    ++support.points;
    double agreement = 1;
    if (compares_color) {
      const Eigen::Vector3f seen = scene.colorAt(scene.range_image.pointAt(std::size_t(cells[i])));
      agreement = colorAgreement(squaredColorDifference(surface.colors[i], seen), color_tolerance);
    }
    support.supported += agreement * weights[i];
  }
  return support;
}

}  // namespace sks
#endif
