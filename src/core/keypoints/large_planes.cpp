// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/stages/large_planes.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/surface/angular_spacing.hpp"
#include "core/surface/clusters.hpp"
#include "core/surface/plane_ransac.hpp"

namespace sks {
namespace {

// A Kinect's depth noise at 2 m [m], and an angle of about 25 degrees.
constexpr PlaneTolerance tolerance{0.012f, 0.9f};
constexpr std::size_t most_samples = 4000;  // points that planes are sought in
constexpr std::size_t most_planes = 4;
constexpr double smallest_share = 0.02;  // of the samples
// Between samples of one part of a plane, in their mean spacing: of points at random nearly all connect.
constexpr double longest_step = 2;

OrientedPoints without(const InfinitePlane& plane, const OrientedPoints& samples) {
  OrientedPoints rest;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!plane.contains(samples.point(i), samples.normal(i), tolerance)) rest.add(samples.point(i), samples.normal(i));
  }
  return rest;
}

/// Mean angle between neighbouring samples, as the sensor sees them [rad].
double spacingOf(const OrientedPoints& samples, const Surface& scene) {
  const double of_all = double(angularSpacing(scene, tolerance.distance));
  return of_all * std::sqrt(double(scene.size()) / double(std::max<std::size_t>(1, samples.size())));
}

/// The smaller extent of the largest part of a plane that hangs together in the picture: sides of several things may
/// lie in one plane, and are not large by that. @param step longest one within a part [rad]
float connectedExtent(const SupportedPlane& plane, const OrientedPoints& samples, const Eigen::Vector3f& sensor,
                      double step) {
  std::vector<Eigen::Vector3f> points, directions;
  for (const std::uint32_t i : plane.members) {
    points.push_back(samples.point(i));
    directions.push_back((points.back() - sensor).stableNormalized());
  }
  return leastSquaresPlane(at(points, findClusters(directions, step).front())).smallerExtent();
}

}  // namespace

bool LargePlane::contains(const Eigen::Vector3f& point, const Eigen::Vector3f& point_normal) const {
  return InfinitePlane{normal, offset}.contains(point, point_normal, tolerance);
}

std::vector<LargePlane> findLargePlanes(const Surface& scene, int threads) {
  OrientedPoints samples;
  for (std::size_t i = 0; i < scene.size(); i += scene.size() / most_samples + 1) {
    if (scene.normal(i).allFinite()) samples.add(scene.point(i), scene.normal(i));
  }
  const std::size_t fewest = std::max<std::size_t>(50, std::size_t(smallest_share * double(samples.size())));
  const double step = longest_step * spacingOf(samples, scene);
  std::mt19937 random(1);
  std::vector<LargePlane> planes;
  while (planes.size() < most_planes && samples.size() >= fewest) {
    const SupportedPlane found = mostSupportedPlane(samples, tolerance, fewest, random, threads);
    if (found.members.size() < fewest) break;
    planes.push_back(
        {found.plane.normal, found.plane.offset, connectedExtent(found, samples, scene.sensor_origin, step)});
    samples = without(found.plane, samples);
  }
  return planes;
}

float planeExtentAt(const std::vector<LargePlane>& planes, const Eigen::Vector3f& point,
                    const Eigen::Vector3f& normal) {
  float extent = 0;
  for (const LargePlane& plane : planes) {
    if (plane.extent > extent && plane.contains(point, normal)) extent = plane.extent;
  }
  return extent;
}

Keypoints keypointsOffPlanes(const Keypoints& keypoints, const std::vector<LargePlane>& planes, float extent) {
  Keypoints kept;
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    const Eigen::Vector3f &position = keypoints.positions[i], &normal = keypoints.normals[i];  // of either sign
    if (std::max(planeExtentAt(planes, position, normal), planeExtentAt(planes, position, -normal)) > extent) continue;
    kept.positions.push_back(position);
    kept.normals.push_back(normal);
    kept.curvature.push_back(keypoints.curvature[i]);
  }
  return kept;
}

}  // namespace sks
