// SPDX-License-Identifier: BSD-3-Clause
#include "core/capture/plane_patch.hpp"

#include <cmath>

#include <random>

#include <sks_detector/stages/point_grid.hpp>

#include "core/surface/plane_fit.hpp"
#include "core/surface/plane_ransac.hpp"

namespace sks {
namespace {

constexpr float agreement = 0.9f;  // cosine between the normals of a plane and of its points; about 25 degrees
constexpr int fewest_neighbors = 5;

/// The points that have a normal, which points to the sensor. @param radius of the neighbourhood for a normal [m]
OrientedPoints withNormals(const std::vector<Eigen::Vector3f>& points, double radius, const Eigen::Vector3f& sensor) {
  const PointGrid grid(points, radius);
  std::vector<float> nx(points.size()), ny(points.size()), nz(points.size());
  fitPlanesAtPoints(grid, 0, grid.size(), float(radius), fewest_neighbors, {nx.data(), ny.data(), nz.data()});
  OrientedPoints oriented;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Eigen::Vector3f normal(nx[i], ny[i], nz[i]);
    if (!normal.allFinite()) continue;
    oriented.add(grid.point(i), normal.dot(sensor - grid.point(i)) < 0 ? Eigen::Vector3f(-normal) : normal);
  }
  return oriented;
}

/// All points at the plane that most points with normals belong to.
Indices planeInliers(const std::vector<Eigen::Vector3f>& points, double tolerance, double gap,
                     const Eigen::Vector3f& sensor) {
  const OrientedPoints oriented = withNormals(points, gap, sensor);
  if (oriented.size() < 3) return {};
  std::mt19937 random(1);
  const InfinitePlane plane = mostSupportedPlane(oriented, {float(tolerance), agreement}, 3, random, 1).plane;
  Indices inliers;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (std::abs(plane.normal.dot(points[i]) - plane.offset) < tolerance) inliers.push_back(i);
  }
  return inliers;
}

void fit(PlanePatch& patch, const Eigen::Vector3f& sensor) {
  const PlaneFit least = leastSquaresPlane(patch.points);
  patch.deviation = std::sqrt(least.variances[0]);
  const bool away = least.normal.dot(sensor.cast<double>() - least.mean) < 0;
  const Eigen::Vector3d normal = away ? Eigen::Vector3d(-least.normal) : least.normal;
  patch.plane = Eigen::Hyperplane<float, 3>(normal.cast<float>(), least.mean.cast<float>());
}

}  // namespace

PlanePatch largestPatch(const std::vector<Eigen::Vector3f>& points, double tolerance, double gap,
                        const Eigen::Vector3f& sensor) {
  PlanePatch patch;
  if (points.size() < 3) return patch;
  patch.inliers = planeInliers(points, tolerance, gap, sensor);
  const std::vector<Eigen::Vector3f> on_plane = at(points, patch.inliers);
  const std::vector<Indices> parts = findClusters(on_plane, gap);
  if (parts.empty() || parts[0].size() < 3) return patch;
  patch.points = at(on_plane, parts[0]);
  fit(patch, sensor);
  return patch;
}

}  // namespace sks
