// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/stages/large_planes.hpp>

#include <algorithm>
#include <random>

#include "core/surface/plane_ransac.hpp"

namespace sks {
namespace {

// A Kinect's depth noise at 2 m [m], and an angle of about 25 degrees.
constexpr PlaneTolerance tolerance{0.012f, 0.9f};
constexpr std::size_t most_samples = 4000;  // points that planes are sought in
constexpr std::size_t most_planes = 4;
constexpr double smallest_share = 0.02;  // of the samples

OrientedPoints without(const InfinitePlane& plane, const OrientedPoints& samples) {
  OrientedPoints rest;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!plane.contains(samples.point(i), samples.normal(i), tolerance)) rest.add(samples.point(i), samples.normal(i));
  }
  return rest;
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
  std::mt19937 random(1);
  std::vector<LargePlane> planes;
  while (planes.size() < most_planes && samples.size() >= fewest) {
    const SupportedPlane found = mostSupportedPlane(samples, tolerance, fewest, random, threads);
    if (found.members.size() < fewest) break;
    planes.push_back({found.plane.normal, found.plane.offset, found.extent});
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
