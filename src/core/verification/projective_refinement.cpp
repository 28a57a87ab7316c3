// SPDX-License-Identifier: BSD-3-Clause
// ICP with pairs along the sensor's rays. Each SIMD lane is one point of the stored surface: it is placed, projected,
// paired and added to the normal equations in one go.
#include "core/verification/projective_refinement.hpp"

#include "core/verification/point_to_plane.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/verification/projective_refinement.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#ifndef SKS_PROJECTIVE_REFINEMENT_ONCE
#define SKS_PROJECTIVE_REFINEMENT_ONCE
namespace sks {

/// Some points of a stored surface side by side, padded with points that face nowhere.
struct SurfaceSample {
  std::vector<float> x, y, z, nx, ny, nz;
  std::size_t size = 0;
};

/// What a round works with.
struct Round {
  Eigen::Matrix<float, 3, 4, Eigen::RowMajor> T_scene_model;
  Eigen::Vector3f pivot;  ///< that the motion turns about, scene frame
  float distance;         ///< farthest pairs [m]
};

}  // namespace sks
#endif

HWY_BEFORE_NAMESPACE();
namespace sks {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, PointGrid::simd_padding>;
using Lane = hn::Vec<Lanes>;

struct Vector3 {
  Lane x, y, z;

  HWY_INLINE Vector3 operator-(const Vector3& o) const { return {hn::Sub(x, o.x), hn::Sub(y, o.y), hn::Sub(z, o.z)}; }
  HWY_INLINE Lane dot(const Vector3& o) const { return hn::MulAdd(x, o.x, hn::MulAdd(y, o.y, hn::Mul(z, o.z))); }
  HWY_INLINE Vector3 cross(const Vector3& o) const {
    return {hn::MulSub(y, o.z, hn::Mul(z, o.y)), hn::MulSub(z, o.x, hn::Mul(x, o.z)),
            hn::MulSub(x, o.y, hn::Mul(y, o.x))};
  }
};

HWY_INLINE Vector3 repeat(const Eigen::Vector3f& v) {
  const Lanes d;
  return {hn::Set(d, v.x()), hn::Set(d, v.y()), hn::Set(d, v.z())};
}

HWY_INLINE Vector3 keep(hn::Mask<Lanes> mask, const Vector3& v) {
  return {hn::IfThenElseZero(mask, v.x), hn::IfThenElseZero(mask, v.y), hn::IfThenElseZero(mask, v.z)};
}

/// `add` is 1 for points and 0 for directions.
HWY_INLINE Vector3 mapped(const Round& round, const Vector3& v, float add) {
  const Lanes d;
  const auto row = [&](int i) {
    const auto& T = round.T_scene_model;
    const auto last = hn::MulAdd(hn::Set(d, T(i, 2)), v.z, hn::Set(d, add * T(i, 3)));
    return hn::MulAdd(hn::Set(d, T(i, 0)), v.x, hn::MulAdd(hn::Set(d, T(i, 1)), v.y, last));
  };
  return {row(0), row(1), row(2)};
}

/// Numbers of the cells in the direction of places; `seen`: where there are any.
HWY_INLINE hn::Vec<hn::RebindToSigned<Lanes>> cellsOf(const RangeImage::Projection& image, const Vector3& place,
                                                      hn::Mask<Lanes>& seen) {
  const Lanes d;
  const hn::RebindToSigned<Lanes> di;
  const auto set = [&](float value) { return hn::Set(d, value); };
  const Vector3 ray = place - repeat(image.origin);
  const auto depth = ray.dot(repeat(image.axes.row(2)));
  seen = hn::Gt(depth, hn::Mul(set(RangeImage::rim), hn::Sqrt(ray.dot(ray))));
  const auto inverse = hn::Div(set(1.0f), hn::IfThenElse(seen, depth, set(1.0f)));
  const auto column = hn::Div(hn::MulSub(ray.dot(repeat(image.axes.row(0))), inverse, set(image.u0)), set(image.cell));
  const auto row = hn::Div(hn::MulSub(ray.dot(repeat(image.axes.row(1))), inverse, set(image.v0)), set(image.cell));
  const auto zero = hn::Zero(d);
  seen =
      hn::And(seen, hn::And(hn::And(hn::Ge(column, zero), hn::Ge(row, zero)),
                            hn::And(hn::Lt(column, set(float(image.width))), hn::Lt(row, set(float(image.height))))));
  const auto index = [&](auto v) { return hn::ConvertTo(di, hn::IfThenElseZero(seen, v)); };
  return hn::Add(hn::Mul(index(row), hn::Set(di, image.width)), index(column));
}

/// Upper triangle of A row by row, then b, then the number of pairs.
void sumPairsImpl(const SurfaceSample& sample, const RangeImage& image, const Round& round, double* sums) {
  const Lanes d;
  static_assert(sizeof(RangeImage::Cell) == 8 * sizeof(float), "cells are looked up as vectors of eight numbers");
  const float* cells = &image.cells().data()->x;
  Lane total[28];
  for (Lane& sum : total) sum = hn::Zero(d);
  for (std::size_t i = 0; i < sample.size; i += hn::Lanes(d)) {
    const auto load = [&](const std::vector<float>& v) { return hn::LoadU(d, v.data() + i); };
    const Vector3 place = mapped(round, {load(sample.x), load(sample.y), load(sample.z)}, 1);
    const Vector3 normal = mapped(round, {load(sample.nx), load(sample.ny), load(sample.nz)}, 0);
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

namespace {

/// Every `stride`-th point. @return their centroid
Eigen::Vector3f take(const TrainingView& view, std::size_t stride, SurfaceSample& sample) {
  for (auto* axis : {&sample.x, &sample.y, &sample.z, &sample.nx, &sample.ny, &sample.nz}) axis->clear();
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  const auto add = [&](const Eigen::Vector3f& p, const Eigen::Vector3f& n) {
    sample.x.push_back(p.x());
    sample.y.push_back(p.y());
    sample.z.push_back(p.z());
    sample.nx.push_back(n.x());
    sample.ny.push_back(n.y());
    sample.nz.push_back(n.z());
  };
  for (std::size_t i = 0; i < view.surface_points.size(); i += stride) {
    add(view.surface_points[i], view.surface_normals[i]);
    sum += view.surface_points[i];
  }
  sample.size = sample.x.size();
  Eigen::Vector3f centroid = sum / float(std::max<std::size_t>(1, sample.size));
  for (std::size_t i = 0; i < PointGrid::simd_padding; ++i) add(centroid, Eigen::Vector3f::Zero());
  return centroid;
}

}  // namespace

Eigen::Isometry3d refineAlongRays(const TrainingView& view, const SceneView& scene, const RefinementSettings& settings,
                                  const Eigen::Isometry3d& T_scene_model) {
  if (scene.range_image.cells().empty()) return T_scene_model;
  thread_local SurfaceSample sample;  // keeps its buffers from pose to pose
  const std::size_t stride = view.surface_points.size() / std::size_t(settings.max_points) + 1;
  const Eigen::Vector3d centroid = take(view, stride, sample).cast<double>();
  Eigen::Isometry3d refined = T_scene_model;
  for (int i = 0; i < settings.iterations; ++i) {
    Round round;
    round.T_scene_model = refined.matrix().topRows<3>().cast<float>();
    round.pivot = (refined * centroid).cast<float>();
    round.distance = float(pairDistance(settings, i));
    double sums[28];
    HWY_DYNAMIC_DISPATCH(sumPairsImpl)(sample, scene.range_image, round, sums);
    if (sums[27] < double(fewest_pairs)) break;
    PointToPlane system(round.pivot.cast<double>());
    system.set(sums);
    refined = system.motion() * refined;
  }
  return refined;
}

}  // namespace sks
#endif
