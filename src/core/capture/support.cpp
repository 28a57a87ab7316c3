// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/support.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <sks_detector/error.hpp>
#include <sks_detector/stages/point_grid.hpp>

#include "core/capture/convex_polygon.hpp"
#include "core/capture/plane_patch.hpp"
#include "core/capture/smallest_rectangle.hpp"
#include "core/surface/plane_fit.hpp"
#include "core/surface/plane_ransac.hpp"
#include "core/surface/sanitize.hpp"
#include "core/surface/voxels.hpp"

namespace sks {
namespace {

constexpr double support_spacing = 0.01;    // of the points in which planes are sought [m]
constexpr double support_tolerance = 0.01;  // farthest that points of a plane lie from it at first [m]
constexpr double support_gap = 0.05;        // what is farther apart is no one plane [m]
constexpr double smallest_support = 0.04;   // [m^2] a square of 0.2 m; things show less
constexpr double uneven = 0.005;            // [m] standard deviation from which on a surface is curved
constexpr int most_supports = 4;            // planes that are looked at

// A plane is fitted again to what lies near it, without the feet of things.
constexpr int refits = 3;
constexpr double near_deviations = 2;
constexpr float nearest_band = 0.002f;  // [m] what is nearer than this belongs to it in any case

// What lies at a plane but belongs to what crosses it, like a wall behind a table, has other normals.
constexpr float normal_radius = 0.025f;  // [m]
constexpr int fewest_for_normal = 5;
constexpr float normal_agreement = 0.9f;  // cosine; about 25 degrees

constexpr double standing_contact = 0.02;  // [m] the boxes of what stands on a plane end nearer to it than this
constexpr float beside = 0.03f;            // [m] how far beyond the outline the middle of what stands there may lie

/// Points of even density that are not part of a plane yet, and their normals, of either sign.
struct Rest {
  std::vector<Eigen::Vector3f> points, normals;
};

Rest thinned(const Cloud& cloud) {
  Rest rest;
  rest.points = groupByVoxel(cloud.points, support_spacing).centroids;
  const PointGrid grid(rest.points, normal_radius);
  std::vector<float> nx(grid.size()), ny(grid.size()), nz(grid.size());
  fitPlanesAtPoints(grid, 0, grid.size(), normal_radius, fewest_for_normal, {nx.data(), ny.data(), nz.data()});
  rest.normals.resize(grid.size());
  for (std::size_t i = 0; i < grid.size(); ++i) rest.normals[grid.source[i]] = {nx[i], ny[i], nz[i]};
  return rest;
}

Rest without(const Indices& ascending, const Rest& all) {
  Rest rest;
  auto next = ascending.begin();
  for (std::uint32_t i = 0; i < all.points.size(); ++i) {
    if (next != ascending.end() && *next == i) {
      ++next;
      continue;
    }
    rest.points.push_back(all.points[i]);
    rest.normals.push_back(all.normals[i]);
  }
  return rest;
}

/// A plane and its points, the largest connected part of them.
struct FlatPart {
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< to the side of the sensor
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();    ///< [m]
  std::vector<Eigen::Vector3f> points;
};

/// A patch without what only touches its plane.
FlatPart flatPart(const PlanePatch& patch, const Rest& rest) {
  FlatPart part{patch.plane.normal(), patch.plane.projection(patch.points.front()), patch.points};
  double deviation = patch.deviation;
  for (int i = 0; i < refits; ++i) {
    const float band = std::max(nearest_band, float(near_deviations * deviation));
    std::vector<Eigen::Vector3f> flat;
    for (const std::uint32_t index : patch.inliers) {
      const Eigen::Vector3f& p = rest.points[index];
      const bool agrees = std::abs(rest.normals[index].dot(part.normal)) > normal_agreement;  // not where it is NaN
      if (agrees && std::abs(part.normal.dot(p - part.mean)) < band) flat.push_back(p);
    }
    const std::vector<Indices> connected = findClusters(flat, support_gap);
    if (connected.empty() || connected.front().size() < 3) return {};
    part.points = at(flat, connected.front());
    const PlaneFit fit = leastSquaresPlane(part.points);
    deviation = std::sqrt(fit.variances[0]);
    const Eigen::Vector3f normal = fit.normal.cast<float>();
    part.normal = normal.dot(patch.plane.normal()) < 0 ? Eigen::Vector3f(-normal) : normal;
    part.mean = fit.mean.cast<float>();
  }
  return part;
}

/// A flat part as a support, with its outline.
class Candidate {
public:
  explicit Candidate(const FlatPart& part)
      : mean_(part.mean),
        normal_(part.normal),
        u_(normal_.unitOrthogonal()),
        v_(normal_.cross(u_)),
        outline_(projected(part.points)) {}

  float area() const { return outline_.area(); }

  /// Between 0 and 1, and 0 where the detection does not stand here; less for what ends above the plane.
  double contact(const Detection& detection) const {
    const Eigen::Vector3f center = detection.T_scene_box.translation().cast<float>();
    const Eigen::Vector3d axes = detection.T_scene_box.linear().transpose() * normal_.cast<double>();
    const double height = double(normal_.dot(center - mean_));
    const double lowest = height - 0.5 * axes.cwiseAbs().dot(detection.box_size);
    const bool above = height > 0 && lowest < standing_contact && outline_.depth(flat(center)) > -beside;
    return above ? 1 - std::max(0.0, lowest) / standing_contact : 0;
  }

  /// But for what stands on it.
  Support support() const {
    const Rectangle rectangle = smallestRectangle(outline_);
    Eigen::Vector3f x = rectangle.long_axis.x() * u_ + rectangle.long_axis.y() * v_;
    Eigen::Index largest = 0;  // the sign is that of one cloud and the next
    x.cwiseAbs().maxCoeff(&largest);
    if (x[largest] < 0) x = -x;
    Support support;
    Eigen::Matrix3d axes;
    axes.col(2) = normal_.cast<double>().normalized();
    axes.col(1) = axes.col(2).cross(x.cast<double>()).normalized();
    axes.col(0) = axes.col(1).cross(axes.col(2));
    support.T_scene_plane.linear() = axes;
    support.T_scene_plane.translation() = spatial(rectangle.center);
    support.size = {rectangle.length, rectangle.width};
    const Eigen::Isometry3d T_plane_scene = support.T_scene_plane.inverse();
    for (const Eigen::Vector2f& corner : outline_.corners()) {
      support.outline.push_back((T_plane_scene * spatial(corner)).head<2>());
    }
    return support;
  }

private:
  Eigen::Vector2f flat(const Eigen::Vector3f& p) const { return {u_.dot(p - mean_), v_.dot(p - mean_)}; }
  Eigen::Vector3d spatial(const Eigen::Vector2f& p) const { return (mean_ + p.x() * u_ + p.y() * v_).cast<double>(); }
  std::vector<Eigen::Vector2f> projected(const std::vector<Eigen::Vector3f>& points) const {
    std::vector<Eigen::Vector2f> on_plane;
    on_plane.reserve(points.size());
    for (const Eigen::Vector3f& p : points) on_plane.push_back(flat(p));
    return on_plane;
  }

  Eigen::Vector3f mean_, normal_, u_, v_;  // u and v span the plane
  ConvexPolygon outline_;
};

/// Those that are large and even enough, the most points first.
std::vector<Candidate> findCandidates(const Cloud& cloud) {
  std::vector<Candidate> candidates;
  Rest rest = thinned(cloud);
  for (int i = 0; i < most_supports; ++i) {
    const PlanePatch patch = largestPatch(rest.points, support_tolerance, support_gap, cloud.sensor_origin);
    if (patch.points.size() < 3) break;
    if (patch.deviation < uneven) {
      const FlatPart part = flatPart(patch, rest);
      if (part.points.size() >= 3) candidates.emplace_back(part);
      if (!candidates.empty() && candidates.back().area() < smallest_support) candidates.pop_back();
    }
    rest = without(patch.inliers, rest);
  }
  return candidates;
}

}  // namespace

std::optional<Support> findSupport(const Cloud& cloud, const std::vector<Detection>& detections,
                                   const SanitizeSettings& settings) {
  std::vector<Candidate> candidates;
  try {
    candidates = findCandidates(sanitize(cloud, settings));
  } catch (const Error&) {  // nothing usable
    return std::nullopt;
  }
  const Candidate* best = nullptr;
  double best_contact = 0;
  std::size_t best_standing = 0;
  for (const Candidate& candidate : candidates) {
    double contact = 0;
    std::size_t standing = 0;
    for (const Detection& detection : detections) {
      const double one = candidate.contact(detection);
      contact += one;
      standing += one > 0 ? 1 : 0;
    }
    const bool better =
        best == nullptr || contact > best_contact || (contact == best_contact && candidate.area() > best->area());
    if (better) best = &candidate, best_contact = contact, best_standing = standing;
  }
  if (best == nullptr) return std::nullopt;
  Support support = best->support();
  support.standing = best_standing;
  return support;
}

}  // namespace sks
