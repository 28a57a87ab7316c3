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

/// What the looks along the rays to a sample's points say.
struct RoughLooks {
  float points = 0, facing = 0;      ///< as in RoughSupport
  float visible = 0, confirmed = 0;  ///< weights; the latter as if all colours agreed
};

}  // namespace sks
#endif

HWY_BEFORE_NAMESPACE();
namespace sks {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// @param size of the points, from the first on, whole SIMD vectors are looked at until that many are
/// @param weights of the points, zeros for the padding
/// @param cells of the confirmed points, -1 of others; padded as the sample is
RoughLooks lookRoughlyImpl(const SurfaceSample& sample, std::size_t size, const float* weights, const RangeImage& image,
                           const RoughLimits& limits, const RigidRows& T, std::int32_t* cells) {
  const Lanes d;
  const hn::RebindToSigned<Lanes> di;
  const auto set = [&](float value) { return hn::Set(d, value); };
  const float* values = &image.cells().data()->x;
  auto facing_points = hn::Zero(d), confirmed_points = hn::Zero(d), visible = hn::Zero(d), confirmed_sum = hn::Zero(d);
  for (std::size_t i = 0; i < size; i += hn::Lanes(d)) {
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
    const auto near = hn::And(seen, hn::And(hn::Gt(normal.dot(found_normal), set(limits.agreement)),
                                            hn::Le(apart.dot(apart), set(limits.distance * limits.distance))));
    const auto confirmed = hn::And(facing, near);
    const auto nearest = look(6), farthest = look(7);
    const auto measured = hn::And(seen, hn::Ge(farthest, hn::Zero(d)));
    const auto behind = hn::Gt(range, hn::Add(farthest, set(limits.occlusion)));
    const auto before = hn::Lt(range, hn::Sub(nearest, set(limits.occlusion)));
    const auto hidden = hn::And(behind, hn::Not(before));
    const auto weight = hn::IfThenElseZero(facing, hn::LoadU(d, weights + i));
    const auto missed = hn::IfThenElse(hidden, hn::Zero(d), weight);
    const auto unconfirmed = hn::IfThenElse(measured, missed, hn::Mul(set(float(unmeasured)), weight));
    visible = hn::Add(visible, hn::IfThenElse(confirmed, weight, unconfirmed));
    confirmed_sum = hn::Add(confirmed_sum, hn::IfThenElseZero(confirmed, weight));
    facing_points = hn::Add(facing_points, hn::IfThenElseZero(facing, set(1)));
    confirmed_points = hn::Add(confirmed_points, hn::IfThenElseZero(confirmed, set(1)));
    hn::StoreU(hn::IfThenElse(hn::RebindMask(di, confirmed), cell, hn::Set(di, -1)), di, cells + i);
  }
  const auto sum = [&](auto lanes) { return hn::GetLane(hn::SumOfLanes(d, lanes)); };
  RoughLooks looks;
  looks.points = sum(confirmed_points), looks.facing = sum(facing_points);
  looks.visible = sum(visible), looks.confirmed = sum(confirmed_sum);
  return looks;
}

}  // namespace HWY_NAMESPACE
}  // namespace sks
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sks {

HWY_EXPORT(lookRoughlyImpl);

namespace {

constexpr std::size_t rough_points = 80, most_points = 2 * rough_points;
constexpr std::size_t glance_share = 4;  // one of so many points

/// Between `rough_points` and `most_points` are taken.
std::size_t roughStride(const TrainingView& view) {
  return std::max<std::size_t>(1, view.surface_points.size() / rough_points);
}

/// Numbers of the points: one of `glance_share`, then those between.
std::vector<std::size_t> roughOrder(std::size_t points, std::size_t stride) {
  std::vector<std::size_t> order;
  for (std::size_t first = 0; first < glance_share; ++first) {
    for (std::size_t i = first * stride; i < points; i += glance_share * stride) order.push_back(i);
  }
  return order;
}

/// How many of the first points a glance looks at: whole SIMD vectors on any computer, so that it sees the same on all.
std::size_t glanceSize(std::size_t points) {
  constexpr std::size_t vector = PointGrid::simd_padding;
  return std::min(points, (points / glance_share + vector - 1) / vector * vector);
}

}  // namespace

RoughSurface::RoughSurface(const TrainingView& view) {
  SurfaceWeigher weigher(view);
  stride = roughStride(view);
  const std::vector<std::size_t> order = roughOrder(view.surface_points.size(), stride);
  sample.take(view.surface_points, view.surface_normals, order);
  for (const std::size_t i : order) {
    const SurfaceWeight weight = weigher.at(i);
    shape.push_back(weight.shape);
    shape_and_color.push_back(weight.shape_and_color);
    if (!view.surface_colors.empty()) colors.push_back(view.surface_colors[i]);
  }
  for (auto* weights : {&shape, &shape_and_color}) weights->resize(weights->size() + PointGrid::simd_padding);
  object_size = view.extent().maxCoeff();
}

double RoughSupport::scoreWithoutVotes() const {
  constexpr int fewest = 6;
  constexpr double prior = 0.2;  // as of votes
  return points < fewest ? 0 : supported / (visible + prior) * std::sqrt(supported);
}

RoughSupport roughSupport(const RoughSurface& surface, const SceneView& scene, const Eigen::Isometry3d& T_scene_model,
                          const RoughLimits& limits, double least_score) {
  RoughSupport support;
  const bool compares_color = scene.color_tolerance > 0 && !surface.colors.empty();
  const std::vector<float>& weights = compares_color ? surface.shape_and_color : surface.shape;
  if (scene.range_image.cells().empty()) return support;
  std::array<std::int32_t, most_points + PointGrid::simd_padding> cells;
  const RigidRows T = T_scene_model.matrix().topRows<3>().cast<float>();
  const std::size_t size = limits.glance ? glanceSize(surface.sample.size) : surface.sample.size;
  const RoughLooks looks = HWY_DYNAMIC_DISPATCH(lookRoughlyImpl)(surface.sample, size, weights.data(),
                                                                 scene.range_image, limits, T, cells.data());
  const double share = double(surface.sample.size) / double(std::max<std::size_t>(1, size));
  support.points = int(share * double(looks.points)), support.facing = int(share * double(looks.facing));
  support.visible = share * double(looks.visible), support.supported = share * double(looks.confirmed);
  support.agreement = share * double(looks.points);
  if (!(compares_color || limits.passes_planes) || support.scoreWithoutVotes() <= least_score) return support;
  double agreements = 0, supported = 0, on_planes = 0;
  const float color_tolerance = limits.color_slack * scene.color_tolerance;
  for (std::size_t i = 0; i < size; ++i) {
    if (cells[i] < 0) continue;
    const std::uint32_t point = scene.range_image.pointAt(std::size_t(cells[i]));
    if (limits.passes_planes && scene.onLargerPlane(point, surface.object_size)) {
      on_planes += double(weights[i]);
      continue;
    }
    double agreement = 1;
    if (compares_color) {
      agreement = colorAgreement(squaredColorDifference(surface.colors[i], scene.colorAt(point)), color_tolerance);
    }
    agreements += agreement;
    supported += agreement * double(weights[i]);
  }
  support.agreement = share * agreements, support.supported = share * supported;
  support.visible = std::max(support.visible - share * on_planes, support.supported);  // whatever rounding does
  return support;
}

}  // namespace sks
#endif
