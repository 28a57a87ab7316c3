// SPDX-License-Identifier: BSD-3-Clause
#include "core/surface/plane_ransac.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace sks {
namespace {

constexpr std::size_t trials = 150;
constexpr int fits = 3;

/// How many points belong to the plane: without branches, so that the compiler takes several at once.
int countOf(const InfinitePlane& plane, const PlaneTolerance& tolerance, const OrientedPoints& points) {
  const Eigen::Vector3f n = plane.normal;
  const float offset = plane.offset, distance_limit = tolerance.distance, agreement = tolerance.agreement;
  const float *x = points.x.data(), *y = points.y.data(), *z = points.z.data();
  const float *nx = points.nx.data(), *ny = points.ny.data(), *nz = points.nz.data();
  const int size = int(points.size());
  int count = 0;
  for (int i = 0; i < size; ++i) {
    const float distance = std::abs(n.x() * x[i] + n.y() * y[i] + n.z() * z[i] - offset);
    const float cosine = n.x() * nx[i] + n.y() * ny[i] + n.z() * nz[i];
    count += int(distance < distance_limit) & int(cosine > agreement);
  }
  return count;
}

std::vector<std::uint32_t> membersOf(const InfinitePlane& plane, const PlaneTolerance& tolerance,
                                     const OrientedPoints& points) {
  std::vector<std::uint32_t> members;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (plane.contains(points.point(i), points.normal(i), tolerance)) members.push_back(i);
  }
  return members;
}

std::vector<Eigen::Vector3f> chosen(const OrientedPoints& points, const std::vector<std::uint32_t>& members) {
  std::vector<Eigen::Vector3f> positions;
  positions.reserve(members.size());
  for (const std::uint32_t i : members) positions.push_back(points.point(i));
  return positions;
}

InfinitePlane bestOfRandom(const OrientedPoints& points, const PlaneTolerance& tolerance, std::mt19937& random,
                           int threads) {
  std::array<InfinitePlane, trials> planes;
  for (InfinitePlane& plane : planes) {
    const std::size_t i = random() % points.size();
    plane.normal = points.normal(i);
    plane.offset = plane.normal.dot(points.point(i));
  }
  std::array<int, trials> counts;
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t trial = 0; trial < trials; ++trial) counts[trial] = countOf(planes[trial], tolerance, points);
  return planes[std::size_t(std::max_element(counts.begin(), counts.end()) - counts.begin())];
}

}  // namespace

void OrientedPoints::add(const Eigen::Vector3f& point, const Eigen::Vector3f& normal) {
  x.push_back(point.x());
  y.push_back(point.y());
  z.push_back(point.z());
  nx.push_back(normal.x());
  ny.push_back(normal.y());
  nz.push_back(normal.z());
}

bool InfinitePlane::contains(const Eigen::Vector3f& point, const Eigen::Vector3f& point_normal,
                             const PlaneTolerance& tolerance) const {
  return std::abs(normal.dot(point) - offset) < tolerance.distance && normal.dot(point_normal) > tolerance.agreement;
}

float PlaneFit::smallerExtent() const {
  return float(std::sqrt(12 * variances[1]));
}

PlaneFit leastSquaresPlane(const std::vector<Eigen::Vector3f>& points) {
  PlaneFit fit;
  for (const Eigen::Vector3f& p : points) fit.mean += p.cast<double>();
  fit.mean /= double(points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3f& p : points) {
    const Eigen::Vector3d offset = p.cast<double>() - fit.mean;
    covariance += offset * offset.transpose();
  }
  covariance /= double(points.size());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  fit.normal = solver.eigenvectors().col(0);
  fit.variances = solver.eigenvalues().cwiseMax(0.0);
  return fit;
}

SupportedPlane mostSupportedPlane(const OrientedPoints& points, const PlaneTolerance& tolerance, std::size_t fewest,
                                  std::mt19937& random, int threads) {
  SupportedPlane found;
  found.plane = bestOfRandom(points, tolerance, random, threads);
  found.members = membersOf(found.plane, tolerance, points);
  for (int i = 0; i < fits && found.members.size() >= fewest; ++i) {
    const PlaneFit fit = leastSquaresPlane(chosen(points, found.members));
    Eigen::Vector3f normal = fit.normal.cast<float>();
    if (normal.dot(found.plane.normal) < 0) normal = -normal;
    found.plane.normal = normal;
    found.plane.offset = normal.dot(fit.mean.cast<float>());
    found.members = membersOf(found.plane, tolerance, points);
  }
  return found;
}

}  // namespace sks
