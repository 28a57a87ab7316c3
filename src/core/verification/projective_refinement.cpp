// SPDX-License-Identifier: BSD-3-Clause
// ICP with pairs along the sensor's rays. Each SIMD lane is one point of the stored surface: it is placed, projected,
// paired and added to the normal equations in one go.
#include "core/verification/projective_refinement.hpp"

#include "core/verification/point_to_plane.hpp"
#include "core/verification/surface_sample.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/verification/projective_refinement.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "core/verification/ray_lanes-inl.hpp"

#ifndef SKS_PROJECTIVE_REFINEMENT_ONCE
#define SKS_PROJECTIVE_REFINEMENT_ONCE
namespace sks {

/// What a round works with.
struct Round {
  RigidRows T_scene_model;
  Eigen::Vector3f pivot;  ///< that the motion turns about, scene frame
  float distance;         ///< farthest pairs [m]
};

}  // namespace sks
#endif

HWY_BEFORE_NAMESPACE();
namespace sks {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Upper triangle of A row by row, then b, then the number of pairs.
void sumPairsImpl(const SurfaceSample& sample, const RangeImage& image, const Round& round, double* sums) {
  const Lanes d;
  static_assert(sizeof(RangeImage::Cell) == 8 * sizeof(float), "cells are looked up as vectors of eight numbers");
  const float* cells = &image.cells().data()->x;
  Lane total[28];
  for (Lane& sum : total) sum = hn::Zero(d);
  for (std::size_t i = 0; i < sample.size; i += hn::Lanes(d)) {
    const auto load = [&](const std::vector<float>& v) { return hn::LoadU(d, v.data() + i); };
    const Vector3 place = mapped(round.T_scene_model, {load(sample.x), load(sample.y), load(sample.z)}, 1);
    const Vector3 normal = mapped(round.T_scene_model, {load(sample.nx), load(sample.ny), load(sample.nz)}, 0);
    hn::Mask<Lanes> seen;
    const auto cell = hn::ShiftLeft<3>(cellsOf(image.projection(), place, seen));
    const auto facing = hn::Gt(normal.dot(repeat(image.projection().origin) - place), hn::Zero(d));
    if (hn::AllFalse(d, hn::And(seen, facing))) continue;
    const auto look = [&](int k) { return hn::GatherIndex(d, cells + k, cell); };
    const Vector3 found{look(0), look(1), look(2)}, found_normal{look(3), look(4), look(5)};
    const Vector3 apart = found - place;
    const auto paired =
        hn::And(hn::And(seen, facing), hn::And(hn::Gt(normal.dot(found_normal), hn::Set(d, normal_agreement)),
                                               hn::Le(apart.dot(apart), hn::Set(d, round.distance * round.distance))));
    const Vector3 n = keep(paired, found_normal);
    const auto residual = n.dot(keep(paired, apart));
    const auto relative = hn::Div(residual, hn::Set(d, round.distance));
    const auto rest = hn::Max(hn::NegMulAdd(relative, relative, hn::Set(d, 1.0f)), hn::Zero(d));
    const auto tukey = hn::IfThenElseZero(paired, hn::Mul(rest, rest));
    const Vector3 turn = (place - repeat(round.pivot)).cross(n);
    const Lane row[] = {turn.x, turn.y, turn.z, n.x, n.y, n.z};
    int at = 0;
    for (int r = 0; r < 6; ++r) {
      const auto weighted = hn::Mul(tukey, row[r]);
      for (int c = r; c < 6; ++c, ++at) total[at] = hn::MulAdd(weighted, row[c], total[at]);
      total[21 + r] = hn::MulAdd(weighted, residual, total[21 + r]);
    }
    total[27] = hn::Add(total[27], hn::IfThenElseZero(paired, hn::Set(d, 1.0f)));
  }
  for (const Lane& sum : total) *sums++ = double(hn::GetLane(hn::SumOfLanes(d, sum)));
}

}  // namespace HWY_NAMESPACE
}  // namespace sks
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sks {

HWY_EXPORT(sumPairsImpl);

Eigen::Isometry3d refineAlongRays(const SurfaceSample& sample, const SceneView& scene,
                                  const RefinementSettings& settings, int rounds,
                                  const Eigen::Isometry3d& T_scene_model, const MotionPrior* prior) {
  if (scene.range_image.cells().empty()) return T_scene_model;
  const Eigen::Vector3d centroid = sample.centroid.cast<double>();
  Eigen::Isometry3d refined = T_scene_model;
  for (int i = 0; i < rounds; ++i) {
    Round round;
    round.T_scene_model = refined.matrix().topRows<3>().cast<float>();
    round.pivot = (refined * centroid).cast<float>();
    round.distance = float(pairDistance(settings, i));
    double sums[28];
    HWY_DYNAMIC_DISPATCH(sumPairsImpl)(sample, scene.range_image, round, sums);
    if (sums[27] < double(fewest_pairs)) break;
    PointToPlane system(round.pivot.cast<double>());
    system.set(sums);
    if (prior != nullptr) system.hold(*prior, refined);
    refined = system.motion() * refined;
  }
  return refined;
}

Eigen::Isometry3d refineAlongRays(const TrainingView& view, const SceneView& scene, const RefinementSettings& settings,
                                  const Eigen::Isometry3d& T_scene_model) {
  thread_local SurfaceSample sample;  // keeps its buffers from pose to pose
  sample.take(view, view.surface_points.size() / std::size_t(settings.max_points) + 1);
  return refineAlongRays(sample, scene, settings, settings.iterations, T_scene_model);
}

}  // namespace sks
#endif
