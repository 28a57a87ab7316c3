// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/support.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>

#include <sks_detector/error.hpp>
#include <sks_detector/stages/point_grid.hpp>

#include "core/capture/convex_polygon.hpp"
#include "core/capture/smallest_rectangle.hpp"
#include "core/surface/clusters.hpp"
#include "core/surface/plane_fit.hpp"
#include "core/surface/plane_ransac.hpp"
#include "core/surface/sanitize.hpp"
#include "core/surface/voxels.hpp"

namespace sks {
namespace {

constexpr double support_spacing = 0.01;      // of the points in which planes are sought [m]
constexpr double support_gap = 0.05;          // what is farther apart is no one plane [m]
constexpr double smallest_support = 0.04;     // [m^2] a square of 0.2 m; things show less
constexpr int most_supports = 6;              // planes that are looked at, in each of two searches
constexpr std::size_t most_searched = 3000;   // points that planes are sought in
constexpr std::size_t fewest_of_plane = 300;  // points of a plane: most of the smallest one

// How far points of a plane lie from it.
constexpr double depth_step = 0.0032;     // [1/m] of the squared distance: steps of a Kinect's depth
constexpr double least_tolerance = 0.01;  // [m]
constexpr double tolerance_per_step = 1.25;

// A plane is fitted again and again to what lies nearer to it: shares of the tolerance. Most of a plane is near in the
// end, of what is curved less.
constexpr std::array<double, 4> fitted_shares{1, 0.7, 0.4, 0.4};
constexpr double least_nearest = 0.5;
constexpr double nearest_band = 0.002;  // [m]

// What lies at a plane but belongs to what crosses it, like a wall behind a table, has other normals.
constexpr float support_normal_radius = 0.025f;  // [m]
constexpr int fewest_for_normal = 5;
constexpr float normal_agreement = 0.9f;  // cosine; about 25 degrees

constexpr float around_things = 0.25f;     // [m] their support is sought so far around their boxes
constexpr double standing_contact = 0.02;  // [m] the boxes of what stands on a plane end nearer to it than this
constexpr double deepest_corner = 0.05;    // [m] what is round may lie so that a corner of its box ends below, and
constexpr double least_contact = 0.1;      // ... counts little then, but stands
constexpr float beside = 0.03f;            // [m] how far beyond the outline the middle of what stands there may lie

/// Points of even density, and their normals, towards the sensor; NaN where there is none.
struct ThinnedScene {
  std::vector<Eigen::Vector3f> points, normals;
  Eigen::Vector3f sensor;
};

ThinnedScene thinnedScene(const Cloud& cloud, SanitizeSettings settings) {
  settings.remove_duplicates = false;  // thinning does
  const Cloud usable = sanitize(cloud, settings);
  ThinnedScene scene{groupByVoxel(usable.points, support_spacing).centroids, {}, cloud.sensor_origin};
  const PointGrid grid(scene.points, support_normal_radius);
  std::vector<float> nx(grid.size()), ny(grid.size()), nz(grid.size());
  fitPlanesAtPoints(grid, 0, grid.size(), support_normal_radius, fewest_for_normal, {nx.data(), ny.data(), nz.data()});
  scene.normals.resize(grid.size());
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Eigen::Vector3f normal(nx[i], ny[i], nz[i]);
    const bool away = normal.dot(scene.sensor - grid.point(i)) < 0;
    scene.normals[grid.source[i]] = away ? Eigen::Vector3f(-normal) : normal;
  }
  return scene;
}

/// Points with normals, all of them or those around the detections.
Indices searchedPoints(const ThinnedScene& scene, const std::vector<Detection>* around) {
  Indices searched;
  for (std::uint32_t i = 0; i < scene.points.size(); ++i) {
    if (!scene.normals[i].allFinite()) continue;
    const auto is_near = [&](const Detection& detection) {
      const float reach = 0.5f * float(detection.box_size.norm()) + around_things;
      return (detection.position().cast<float>() - scene.points[i]).squaredNorm() < reach * reach;
    };
    if (around == nullptr || std::any_of(around->begin(), around->end(), is_near)) searched.push_back(i);
  }
  return searched;
}

/// A plane and its points, a connected part of them.
struct FlatPart {
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< to the side of the sensor
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();    ///< [m]
  std::vector<Eigen::Vector3f> points;               ///< none where this is no plane
};

/// The connected part of a plane that holds most of the searched points.
std::vector<Eigen::Vector3f> connectedPart(const ThinnedScene& scene, const InfinitePlane& plane, double band,
                                           const std::vector<char>& is_searched) {
  Indices members;
  for (std::uint32_t i = 0; i < scene.points.size(); ++i) {
    if (plane.contains(scene.points[i], scene.normals[i], {float(band), normal_agreement})) members.push_back(i);
  }
  const std::vector<Eigen::Vector3f> points = at(scene.points, members);
  Indices best;
  std::ptrdiff_t most = 0;
  for (Indices& part : findClusters(points, support_gap)) {
    const auto count =
        std::count_if(part.begin(), part.end(), [&](std::uint32_t i) { return is_searched[members[i]] != 0; });
    if (count > most) most = count, best = std::move(part);
  }
  return at(points, best);
}

/// Fitted to ever fewer points, so that of two planes of nearly the same height the one with more points remains.
FlatPart flatPart(const ThinnedScene& scene, InfinitePlane plane, double tolerance,
                  const std::vector<char>& is_searched) {
  FlatPart part;
  std::size_t nearest = 0;
  for (const double share : fitted_shares) {
    const double step = depth_step * double((part.mean - scene.sensor).squaredNorm());
    const double band = std::max({share * tolerance, nearest > 0 ? step : 0, nearest_band});
    const std::vector<Eigen::Vector3f> points = connectedPart(scene, plane, band, is_searched);
    if (points.size() < 3) return {};
    const PlaneFit fit = leastSquaresPlane(points);
    const bool away = fit.normal.dot(scene.sensor.cast<double>() - fit.mean) < 0;
    part.normal = (away ? Eigen::Vector3d(-fit.normal) : fit.normal).cast<float>();
    part.mean = fit.mean.cast<float>();
    plane = {part.normal, part.normal.dot(part.mean)};
    nearest = points.size();
  }
  part.points = connectedPart(scene, plane, tolerance, is_searched);
  const bool is_curved = double(nearest) < least_nearest * double(part.points.size());
  return is_curved ? FlatPart() : part;
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

  /// Up to 1 for what ends at the plane, and 0 where the detection does not stand here.
  double contact(const Detection& detection) const {
    const Eigen::Vector3f center = detection.T_scene_box.translation().cast<float>();
    const Eigen::Vector3d axes = detection.T_scene_box.linear().transpose() * normal_.cast<double>();
    const double height = double(normal_.dot(center - mean_));
    const double lowest = height - 0.5 * axes.cwiseAbs().dot(detection.box_size);
    if (height <= 0 || lowest >= standing_contact || outline_.depth(flat(center)) <= -beside) return 0;
    return lowest > 0 ? 1 - lowest / standing_contact : std::max(least_contact, 1 + lowest / deepest_corner);
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
      support.outline.emplace_back((T_plane_scene * spatial(corner)).head<2>());
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

/// Those that are large and even enough, the most points first. @param around null: everywhere
std::vector<Candidate> findCandidates(const ThinnedScene& scene, const std::vector<Detection>* around) {
  std::vector<Candidate> candidates;
  Indices searched = searchedPoints(scene, around);
  std::vector<char> is_searched(scene.points.size(), 0);
  for (const std::uint32_t i : searched) is_searched[i] = 1;
  std::mt19937 random(1);
  for (int i = 0; i < most_supports; ++i) {
    const std::size_t stride = searched.size() / most_searched + 1;
    OrientedPoints samples;
    double squared = 0;
    for (std::size_t k = 0; k < searched.size(); k += stride) {
      const std::uint32_t index = searched[k];
      samples.add(scene.points[index], scene.normals[index]);
      squared += double((scene.points[index] - scene.sensor).squaredNorm());
    }
    const std::size_t fewest = std::max<std::size_t>(3, fewest_of_plane / stride);
    if (samples.size() < fewest) break;
    const double step = depth_step * squared / double(samples.size());
    const PlaneTolerance tolerance{float(std::max(least_tolerance, tolerance_per_step * step)), normal_agreement};
    const SupportedPlane found = mostSupportedPlane(samples, tolerance, fewest, random, 1);
    if (found.members.size() < fewest) break;
    const FlatPart part = flatPart(scene, found.plane, tolerance.distance, is_searched);
    if (!part.points.empty()) candidates.emplace_back(part);
    if (!part.points.empty() && candidates.back().area() < smallest_support) candidates.pop_back();
    const InfinitePlane fitted{part.normal, part.normal.dot(part.mean)};
    const InfinitePlane& plane = part.points.empty() ? found.plane : fitted;
    const auto on_plane = [&](std::uint32_t index) {
      return plane.contains(scene.points[index], scene.normals[index], tolerance);
    };
    searched.erase(std::remove_if(searched.begin(), searched.end(), on_plane), searched.end());
  }
  return candidates;
}

/// The one that most stands on, with what stands there; none of no candidates.
std::optional<Support> bestOf(const std::vector<Candidate>& candidates, const std::vector<Detection>& detections) {
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
    const bool larger = best == nullptr || candidate.area() > best->area();
    if (contact < best_contact || (contact == best_contact && !larger)) continue;
    best = &candidate, best_contact = contact, best_standing = standing;
  }
  if (best == nullptr) return std::nullopt;
  Support support = best->support();
  support.standing = best_standing;
  return support;
}

}  // namespace

std::optional<Support> findSupport(const Cloud& cloud, const std::vector<Detection>& detections,
                                   const SanitizeSettings& settings) {
  ThinnedScene scene;
  try {
    scene = thinnedScene(cloud, settings);
  } catch (const Error&) {  // nothing usable
    return std::nullopt;
  }
  if (!detections.empty()) {
    std::optional<Support> around = bestOf(findCandidates(scene, &detections), detections);
    if (around && around->standing > 0) return around;
  }
  return bestOf(findCandidates(scene, nullptr), detections);
}

}  // namespace sks
