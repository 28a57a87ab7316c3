// SPDX-License-Identifier: BSD-3-Clause
#include "core/capture/tabletop.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include <sks_detector/error.hpp>
#include <sks_detector/stages/point_grid.hpp>

#include "core/capture/convex_polygon.hpp"
#include "core/capture/plane_patch.hpp"
#include "core/surface/voxels.hpp"

namespace sks {
namespace {

constexpr double patch_spacing = 0.01;     // of the points in which planes are sought [m]
constexpr double patch_gap = 0.05;         // what is farther apart is no one plane [m]
constexpr double cluster_spacing = 0.005;  // of the points that are clustered [m]
constexpr double contact = 0.02;           // lowest points of objects that stand on a plane, above its noise [m]
constexpr float inner_border = 0.02f;      // things that do not reach so far over the plane are what bounds it [m]
constexpr int most_tried_planes = 4;
constexpr double least_share = 0.25;  // of the largest plane's area

// Standard deviation of a plane's points, of its tolerance: noise lies below, the crest of a round thing above.
constexpr double largest_roughness = 0.5;
// Share of a thing that may lie next to points that are neither on nor above the plane: strays of the sensor.
constexpr double most_open = 0.1;

/// What rises above a patch.
class Stage {
public:
  Stage(const PlanePatch& patch, const TabletopSettings& settings)
      : settings_(settings),
        plane_(patch.plane),
        lift_(float(std::max(settings.min_height, 3 * patch.deviation))),
        u_(plane_.normal().unitOrthogonal()),
        v_(plane_.normal().cross(u_)),
        outline_(projected(patch.points)) {}

  double area() const { return outline_.area(); }
  double lift() const { return lift_; }

  std::vector<Indices> objects(const Cloud& cloud, const Indices& finite) const {
    Indices above, beyond;
    for (const std::uint32_t i : finite) {
      const float height = plane_.signedDistance(cloud.points[i]);
      const bool inside = depth(cloud.points[i]) >= 0;
      if (height > lift_ && height < settings_.max_height && inside) {
        above.push_back(i);
      } else if (height < -float(std::max(double(lift_), settings_.plane_tolerance)) || height > lift_) {
        beyond.push_back(i);
      }
    }
    PointGrid surroundings;
    if (!beyond.empty()) {
      surroundings = PointGrid(groupByVoxel(at(cloud.points, beyond), cluster_spacing).centroids, settings_.gap);
    }
    const std::vector<Eigen::Vector3f> points = at(cloud.points, above);
    const VoxelGroups voxels = groupByVoxel(points, cluster_spacing);
    std::vector<Indices> objects;
    for (const Indices& cluster : findClusters(voxels.centroids, settings_.gap)) {
      if (isPart(at(voxels.centroids, cluster), surroundings)) continue;
      Indices object;
      for (const std::uint32_t v : cluster) {
        for (std::uint32_t k = voxels.begin[v]; k < voxels.begin[v + 1]; ++k) object.push_back(above[voxels.points[k]]);
      }
      std::sort(object.begin(), object.end());
      if (stands(at(cloud.points, object))) objects.push_back(std::move(object));
    }
    const auto larger = [](const Indices& a, const Indices& b) { return a.size() > b.size(); };
    std::stable_sort(objects.begin(), objects.end(), larger);
    const auto stray = [&](const Indices& object) {
      return double(object.size()) < settings_.min_share * double(objects.front().size());
    };
    objects.erase(std::find_if(objects.begin(), objects.end(), stray), objects.end());
    return objects;
  }

private:
  std::vector<Eigen::Vector2f> projected(const std::vector<Eigen::Vector3f>& points) const {
    std::vector<Eigen::Vector2f> flat;
    flat.reserve(points.size());
    for (const auto& p : points) flat.emplace_back(p.dot(u_), p.dot(v_));
    return flat;
  }

  float depth(const Eigen::Vector3f& p) const { return outline_.depth({p.dot(u_), p.dot(v_)}); }

  /// Whether a thing goes on where the plane does not. What is held before the camera does: the plane is a side of it,
  /// or of the arm, then.
  bool isPart(const std::vector<Eigen::Vector3f>& points, const PointGrid& surroundings) const {
    if (surroundings.size() == 0) return false;
    std::vector<PointGrid::Run> runs;
    std::size_t open = 0;
    for (const Eigen::Vector3f& p : points) {
      bool near = false;
      surroundings.forEachNeighbor(p, float(settings_.gap), runs, [&](std::uint32_t, float) { near = true; });
      open += near ? 1 : 0;
    }
    return double(open) > most_open * double(points.size());
  }

  bool stands(const std::vector<Eigen::Vector3f>& points) const {
    if (points.size() < std::size_t(settings_.min_points)) return false;
    Eigen::AlignedBox3f box;
    float lowest = std::numeric_limits<float>::infinity(), deepest = 0;
    for (const auto& p : points) {
      box.extend(p);
      lowest = std::min(lowest, plane_.signedDistance(p));
      deepest = std::max(deepest, depth(p));
    }
    return lowest < lift_ + contact && deepest > inner_border && box.sizes().maxCoeff() < settings_.max_extent;
  }

  const TabletopSettings& settings_;
  Eigen::Hyperplane<float, 3> plane_;
  float lift_;
  Eigen::Vector3f u_, v_;  // span the plane
  ConvexPolygon outline_;
};

void remove(std::vector<Eigen::Vector3f>& points, const Indices& ascending) {
  std::vector<Eigen::Vector3f> rest;
  auto next = ascending.begin();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (next != ascending.end() && *next == i) {
      ++next;
    } else {
      rest.push_back(points[i]);
    }
  }
  points = std::move(rest);
}

Indices measuredPoints(const Cloud& cloud) {
  Indices measured;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f& p = cloud.points[i];
    if (p.allFinite() && p != cloud.sensor_origin) measured.push_back(std::uint32_t(i));
  }
  return measured;
}

}  // namespace

Tabletop findTabletop(const Cloud& cloud, const TabletopSettings& settings) {
  const Indices measured = measuredPoints(cloud);
  std::vector<Eigen::Vector3f> thinned = groupByVoxel(at(cloud.points, measured), patch_spacing).centroids;
  Tabletop best;
  for (int i = 0; i < most_tried_planes; ++i) {
    const PlanePatch patch = largestPatch(thinned, settings.plane_tolerance, patch_gap, cloud.sensor_origin);
    if (patch.points.size() < 3) break;
    if (patch.deviation > largest_roughness * settings.plane_tolerance) {
      remove(thinned, patch.inliers);
      continue;
    }
    const Stage stage(patch, settings);
    if (stage.area() < std::max(settings.min_area, least_share * best.area)) break;
    Tabletop tabletop{patch.plane, stage.area(), stage.lift(), stage.objects(cloud, measured)};
    if (best.area == 0 || !tabletop.objects.empty()) best = std::move(tabletop);
    if (!best.objects.empty()) break;
    remove(thinned, patch.inliers);
  }
  if (best.area == 0) {
    throw Error(ErrorCode::bad_data, "there is no plane in the cloud (" + std::to_string(measured.size()) +
                                         " measured points): let the camera see the table that the object stands on");
  }
  return best;
}

Cloud cutOut(const Cloud& cloud, const std::vector<std::uint32_t>& points) {
  Cloud result;
  result.sensor_origin = cloud.sensor_origin;
  if (!cloud.organized()) {
    result.width = std::uint32_t(points.size());
    result.points = at(cloud.points, points);
    for (const std::uint32_t i : points) {
      if (cloud.hasColor()) result.colors.push_back(cloud.colors[i]);
    }
    return result;
  }
  std::uint32_t left = cloud.width, right = 0;
  for (const std::uint32_t i : points) {
    left = std::min(left, i % cloud.width);
    right = std::max(right, i % cloud.width);
  }
  const std::uint32_t top = points.front() / cloud.width, bottom = points.back() / cloud.width;
  result.width = right - left + 1;
  result.height = bottom - top + 1;
  const std::size_t size = std::size_t(result.width) * result.height;
  result.points.assign(size, Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  if (cloud.hasColor()) result.colors.resize(size);
  for (const std::uint32_t i : points) {
    const std::size_t to = std::size_t(i / cloud.width - top) * result.width + (i % cloud.width - left);
    result.points[to] = cloud.points[i];
    if (cloud.hasColor()) result.colors[to] = cloud.colors[i];
  }
  return result;
}

}  // namespace sks
