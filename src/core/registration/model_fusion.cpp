// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/model_fusion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>

#include "core/registration/view_exposure.hpp"
#include "core/surface/color_space.hpp"
#include "core/surface/sided_cube.hpp"
#include "core/verification/pose_evidence.hpp"

namespace sks {
namespace {

constexpr double cubes_per_resolution = 2;
constexpr std::size_t fewest_contradictions = 2;  // one camera may have lost a part of the object
constexpr int fewest_around = 4;                  // within `neighborhood` cubes: fewer are stray points
constexpr float neighborhood = 2.5f;              // [cubes]

/// A point of a view in the model, and the cube in which it is averaged.
struct ModelPoint {
  SidedCube cube;
  std::uint32_t view = 0, point = 0;
};

struct Averaged {
  Eigen::Vector3f point, normal, color;
  std::vector<std::uint32_t> views;  // that saw it, ascending
};

class Fusion {
public:
  Fusion(const std::vector<CapturedView>& views, const std::vector<std::optional<Eigen::Isometry3d>>& poses,
         const Settings& settings)
      : views_(views), poses_(poses), settings_(settings), edge_(float(fusedSpacing(settings))) {}

  FusedModel fused() {
    collect();
    compareExposures();
    std::vector<Averaged> surface = averaged();
    surface.erase(std::remove_if(surface.begin(), surface.end(), [&](const Averaged& p) { return isRemnant(p); }),
                  surface.end());
    surface = withoutStrayPoints(surface);
    FusedModel model;
    const bool colored = std::all_of(views_.begin(), views_.end(), [](const CapturedView& v) { return v.hasColor(); });
    bool on_plane = false;
    for (std::size_t v = 0; v < views_.size(); ++v) on_plane = on_plane || (poses_[v] && views_[v].plane);
    for (const Averaged& p : surface) {
      model.points.push_back(p.point);
      model.normals.push_back(p.normal);
      if (colored) model.colors.push_back(fromScaledLab({p.color[0], p.color[1], p.color[2]}));
      model.box.extend(p.point);
    }
    if (on_plane && !model.box.isEmpty())
      model.box.extend(Eigen::Vector3f(model.box.center().x(), model.box.center().y(), 0));
    return model;
  }

private:
  void collect() {
    for (std::uint32_t v = 0; v < views_.size(); ++v) {
      if (!poses_[v]) continue;
      const Eigen::Isometry3f T = poses_[v]->cast<float>();
      for (std::uint32_t i = 0; i < views_[v].points.size(); ++i) {
        all_.push_back({sidedCube(T * views_[v].points.point(i), T.linear() * views_[v].normals[i], edge_), v, i});
      }
    }
    std::sort(all_.begin(), all_.end(), [](const ModelPoint& a, const ModelPoint& b) {
      return std::tie(a.cube, a.view, a.point) < std::tie(b.cube, b.view, b.point);
    });
  }

  void compareExposures() {
    std::vector<SeenColor> seen;
    std::uint32_t place = 0;
    for (std::size_t i = 0; i < all_.size(); ++i) {
      if (i > 0 && !(all_[i].cube == all_[i - 1].cube)) ++place;
      if (views_[all_[i].view].hasColor()) seen.push_back({place, all_[i].view, colorOf(all_[i])});
    }
    exposures_ = exposureFactors(seen, views_.size());
  }

  Rgb colorOf(const ModelPoint& p) const {
    const Eigen::Vector3f& lab = views_[p.view].colors[p.point];
    return fromScaledLab({lab[0], lab[1], lab[2]});
  }

  Eigen::Vector3f exposedColorOf(const ModelPoint& p) const {
    const std::array<float, 3> lab = toScaledLab(exposed(colorOf(p), exposures_[p.view]));
    return {lab[0], lab[1], lab[2]};
  }

  std::vector<Averaged> averaged() const {
    std::vector<Averaged> surface;
    for (std::size_t begin = 0, end = 0; begin < all_.size(); begin = end) {
      Averaged sum{Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero(), {}};
      float weights = 0;
      for (end = begin; end < all_.size() && all_[end].cube == all_[begin].cube; ++end) {
        const CapturedView& view = views_[all_[end].view];
        const std::uint32_t i = all_[end].point;
        const Eigen::Isometry3f T = poses_[all_[end].view]->cast<float>();
        const Eigen::Vector3f ray = view.surface.sensor_origin - view.points.point(i);
        // The depth error grows with the square of the range, and along the surface with its slant.
        const float weight = std::max(grazing, view.normals[i].dot(ray) / ray.norm()) / ray.squaredNorm();
        weights += weight;
        sum.point += weight * (T * view.points.point(i));
        sum.normal += weight * (T.linear() * view.normals[i]);
        if (view.hasColor()) sum.color += weight * exposedColorOf(all_[end]);
        if (sum.views.empty() || sum.views.back() != all_[end].view) sum.views.push_back(all_[end].view);
      }
      if (!(sum.normal.norm() > 0)) continue;
      sum.point /= weights;
      sum.color /= weights;
      sum.normal.normalize();
      surface.push_back(std::move(sum));
    }
    return surface;
  }

  /// Whether several cameras say that nothing is there and only one has seen it, or as many as have seen it looked
  /// through it.
  bool isRemnant(const Averaged& p) const {
    const float distance = float(settings_.verification.support_distance);
    std::size_t through = 0, past = 0;
    for (std::size_t v = 0; v < views_.size(); ++v) {
      if (!poses_[v] || std::binary_search(p.views.begin(), p.views.end(), std::uint32_t(v))) continue;
      const Eigen::Vector3f in_view = poses_[v]->cast<float>().inverse() * p.point;
      const Sighting seen = views_[v].image.look(in_view, distance);
      const bool beside = seen.sight == Sight::unknown && views_[v].silhouette.isOutside(in_view, distance);
      through += seen.sight == Sight::in_front ? 1 : 0;
      past += beside ? 1 : 0;
    }
    return through >= p.views.size() || (p.views.size() == 1 && through + past >= fewest_contradictions);
  }

  std::vector<Averaged> withoutStrayPoints(const std::vector<Averaged>& surface) const {
    std::vector<Eigen::Vector3f> points;
    for (const Averaged& p : surface) points.push_back(p.point);
    const float radius = neighborhood * edge_;
    const PointGrid grid(points, double(radius));
    std::vector<PointGrid::Run> runs;
    std::vector<Averaged> kept;
    for (const Averaged& p : surface) {
      int neighbors = -1;  // without itself
      grid.forEachNeighbor(p.point, radius, runs, [&](std::uint32_t, float) { ++neighbors; });
      if (neighbors >= fewest_around) kept.push_back(p);
    }
    return kept;
  }

  const std::vector<CapturedView>& views_;
  const std::vector<std::optional<Eigen::Isometry3d>>& poses_;
  const Settings& settings_;
  float edge_;
  std::vector<ModelPoint> all_;            // by cube
  std::vector<Eigen::Array3f> exposures_;  // of the views
};

}  // namespace

double fusedSpacing(const Settings& settings) {
  return settings.training.surface_resolution / cubes_per_resolution;
}

FusedModel fuseViews(const std::vector<CapturedView>& views, const std::vector<std::optional<Eigen::Isometry3d>>& poses,
                     const Settings& settings) {
  return Fusion(views, poses, settings).fused();
}

FusedModel thinnedModel(const FusedModel& model, double spacing) {
  std::map<SidedCube, std::size_t> first;  // point of each cube
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    first.emplace(sidedCube(model.points[i], model.normals[i], float(spacing)), i);
  }
  FusedModel thinned;
  thinned.box = model.box;
  for (const auto& [cube, i] : first) {
    thinned.points.push_back(model.points[i]);
    thinned.normals.push_back(model.normals[i]);
    if (!model.colors.empty()) thinned.colors.push_back(model.colors[i]);
  }
  return thinned;
}

}  // namespace sks
