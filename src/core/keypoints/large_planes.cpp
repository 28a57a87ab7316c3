// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/stages/large_planes.hpp>

#include <algorithm>
#include <array>
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

/// Points that planes are sought in, side by side.
struct Samples {
  std::size_t size() const { return x.size(); }
  Eigen::Vector3f point(std::size_t i) const { return {x[i], y[i], z[i]}; }
  Eigen::Vector3f normal(std::size_t i) const { return {nx[i], ny[i], nz[i]}; }
  void add(const Eigen::Vector3f& point, const Eigen::Vector3f& normal) {
    x.push_back(point.x());
    y.push_back(point.y());
    z.push_back(point.z());
    nx.push_back(normal.x());
    ny.push_back(normal.y());
    nz.push_back(normal.z());
  }

  std::vector<float> x, y, z, nx, ny, nz;
};

/// How many of the samples belong to the plane: without branches, so that the compiler takes several at once.
int countOf(const LargePlane& plane, const Samples& samples) {
  const Eigen::Vector3f n = plane.normal;
  const float offset = plane.offset;
  const float *x = samples.x.data(), *y = samples.y.data(), *z = samples.z.data();
  const float *nx = samples.nx.data(), *ny = samples.ny.data(), *nz = samples.nz.data();
  const int size = int(samples.size());
  int count = 0;
  for (int i = 0; i < size; ++i) {
    const float distance = std::abs(n.x() * x[i] + n.y() * y[i] + n.z() * z[i] - offset);
    const float cosine = n.x() * nx[i] + n.y() * ny[i] + n.z() * nz[i];
    count += int(distance < thickness) & int(cosine > agreement);
  }
  return count;
}

std::vector<std::uint32_t> membersOf(const LargePlane& plane, const Samples& samples) {
  std::vector<std::uint32_t> members;
  for (std::uint32_t i = 0; i < samples.size(); ++i) {
    if (plane.contains(samples.point(i), samples.normal(i))) members.push_back(i);
  }
  return members;
}

Samples without(const LargePlane& plane, const Samples& samples) {
  Samples rest;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!plane.contains(samples.point(i), samples.normal(i))) rest.add(samples.point(i), samples.normal(i));
  }
  return rest;
}

/// The plane through one of the samples that most of them belong to.
LargePlane mostSupported(const Samples& samples, std::mt19937& random, int threads) {
  std::array<LargePlane, trials> planes;
  for (LargePlane& plane : planes) {
    const std::size_t i = random() % samples.size();
    plane.normal = samples.normal(i);
    plane.offset = plane.normal.dot(samples.point(i));
  }
  std::array<int, trials> counts;
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t trial = 0; trial < trials; ++trial) counts[trial] = countOf(planes[trial], samples);
  return planes[std::size_t(std::max_element(counts.begin(), counts.end()) - counts.begin())];
}

LargePlane fitted(const LargePlane& plane, const Samples& samples, const std::vector<std::uint32_t>& members) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const std::uint32_t i : members) mean += samples.point(i).cast<double>();
  mean /= double(members.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const std::uint32_t i : members) {
    const Eigen::Vector3d offset = samples.point(i).cast<double>() - mean;
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

std::vector<LargePlane> findLargePlanes(const Surface& scene, int threads) {
  Samples samples;
  for (std::size_t i = 0; i < scene.size(); i += scene.size() / most_samples + 1) {
    if (scene.normal(i).allFinite()) samples.add(scene.point(i), scene.normal(i));
  }
  const std::size_t fewest = std::max<std::size_t>(50, std::size_t(smallest_share * double(samples.size())));
  std::mt19937 random(1);
  std::vector<LargePlane> planes;
  while (planes.size() < most_planes && samples.size() >= fewest) {
    LargePlane plane = mostSupported(samples, random, threads);
    std::vector<std::uint32_t> members = membersOf(plane, samples);
    for (int i = 0; i < 3 && members.size() >= fewest; ++i) {
      plane = fitted(plane, samples, members);
      members = membersOf(plane, samples);
    }
    if (members.size() < fewest) break;
    planes.push_back(plane);
    samples = without(plane, samples);
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
