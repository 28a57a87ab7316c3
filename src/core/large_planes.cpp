// SPDX-License-Identifier: BSD-3-Clause
#include "core/large_planes.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <Eigen/Eigenvalues>

namespace sks {
namespace {

constexpr float thickness = 0.012f;         // [m] to either side; a Kinect's depth noise at 2 m
constexpr float agreement = 0.9f;           // cosine between normals; about 25 degrees
constexpr std::size_t most_samples = 4000;  // points that planes are sought in
constexpr std::size_t most_planes = 4;
constexpr std::size_t trials = 150;
constexpr double smallest_share = 0.02;  // of the samples

std::vector<std::uint32_t> membersOf(const LargePlane& plane, const Surface& scene,
                                     const std::vector<std::uint32_t>& samples) {
  std::vector<std::uint32_t> members;
  for (const std::uint32_t i : samples) {
    if (plane.contains(scene.point(i), scene.normal(i))) members.push_back(i);
  }
  return members;
}

LargePlane mostSupported(const Surface& scene, const std::vector<std::uint32_t>& samples, std::mt19937& random) {
  LargePlane best;
  std::size_t most = 0;
  for (std::size_t trial = 0; trial < trials; ++trial) {
    const std::uint32_t i = samples[random() % samples.size()];
    LargePlane plane;
    plane.normal = scene.normal(i);
    plane.offset = plane.normal.dot(scene.point(i));
    const std::size_t count = std::size_t(std::count_if(samples.begin(), samples.end(), [&](std::uint32_t j) {
      return plane.contains(scene.point(j), scene.normal(j));
    }));
    if (count > most) {
      most = count;
      best = plane;
    }
  }
  return best;
}

LargePlane fitted(const LargePlane& plane, const Surface& scene, const std::vector<std::uint32_t>& members) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const std::uint32_t i : members) mean += scene.point(i).cast<double>();
  mean /= double(members.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const std::uint32_t i : members) {
    const Eigen::Vector3d offset = scene.point(i).cast<double>() - mean;
    covariance += offset * offset.transpose();
  }
  covariance /= double(members.size());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  LargePlane fit;
  fit.normal = solver.eigenvectors().col(0).cast<float>();
  if (fit.normal.dot(plane.normal) < 0) fit.normal = -fit.normal;
  fit.offset = fit.normal.dot(mean.cast<float>());
  fit.extent = float(std::sqrt(12 * std::max(0.0, solver.eigenvalues()[1])));  // of a rectangle with that variance
  return fit;
}

}  // namespace

bool LargePlane::contains(const Eigen::Vector3f& point, const Eigen::Vector3f& point_normal) const {
  return std::abs(normal.dot(point) - offset) < thickness && normal.dot(point_normal) > agreement;
}

std::vector<LargePlane> findLargePlanes(const Surface& scene) {
  std::vector<std::uint32_t> samples;
  for (std::size_t i = 0; i < scene.size(); i += scene.size() / most_samples + 1) {
    if (scene.normal(i).allFinite()) samples.push_back(std::uint32_t(i));
  }
  const std::size_t fewest = std::max<std::size_t>(50, std::size_t(smallest_share * double(samples.size())));
  std::mt19937 random(1);
  std::vector<LargePlane> planes;
  while (planes.size() < most_planes && samples.size() >= fewest) {
    LargePlane plane = mostSupported(scene, samples, random);
    std::vector<std::uint32_t> members = membersOf(plane, scene, samples);
    for (int i = 0; i < 3 && members.size() >= fewest; ++i) {
      plane = fitted(plane, scene, members);
      members = membersOf(plane, scene, samples);
    }
    if (members.size() < fewest) break;
    planes.push_back(plane);
    samples.erase(std::remove_if(samples.begin(), samples.end(),
                                 [&](std::uint32_t i) { return plane.contains(scene.point(i), scene.normal(i)); }),
                  samples.end());
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

}  // namespace sks
