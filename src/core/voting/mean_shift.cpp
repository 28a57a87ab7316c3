// SPDX-License-Identifier: BSD-3-Clause
#include "core/voting/mean_shift.hpp"

#include <algorithm>
#include <tuple>

#include <sks_detector/stages/point_grid.hpp>

#include "core/voting/gaussian_kernel.hpp"

namespace sks {
namespace {

/// Kernel sum at `x` and the kernel's mean of the points: one mean shift step.
double shift(const PointGrid& points, double bandwidth, const Eigen::Vector3f& x, std::vector<PointGrid::Run>& runs,
             Eigen::Vector3f& mean) {
  const GaussianKernel<double> kernel = shiftKernel(bandwidth);
  double density = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  points.forEachNeighbor(x, float(kernel.reach()), runs, [&](std::uint32_t i, float squared) {
    const double weight = kernel(squared);
    density += weight;
    sum += weight * (points.point(i) - x).cast<double>();
  });
  mean = density > 0 ? Eigen::Vector3f(x + (sum / density).cast<float>()) : x;
  return density;
}

/// Follows the density uphill from `x`.
Maximum climb(const PointGrid& points, const VotingSettings& settings, Eigen::Vector3f x,
              std::vector<PointGrid::Run>& runs) {
  Maximum maximum;
  for (int i = 0; i < settings.max_iterations; ++i) {
    Eigen::Vector3f next;
    shift(points, settings.bandwidth, x, runs, next);
    const float step = (next - x).norm();
    x = next;
    if (step < settings.tolerance) break;
  }
  Eigen::Vector3f unused;
  maximum.position = x;
  maximum.density = shift(points, settings.bandwidth, x, runs, unused);
  return maximum;
}

bool stronger(const Maximum& a, const Maximum& b) {
  const auto key = [](const Maximum& m) {
    return std::make_tuple(-m.density, m.position.x(), m.position.y(), m.position.z());
  };
  return key(a) < key(b);
}

}  // namespace

double kernelDensity(const Eigen::Vector3f& x, const std::vector<Eigen::Vector3f>& points, double bandwidth) {
  const GaussianKernel<double> kernel = shiftKernel(bandwidth);
  double density = 0;
  for (const auto& p : points) {
    const double squared = (p - x).cast<double>().squaredNorm();
    if (squared <= kernel.reach() * kernel.reach()) density += kernel(squared);
  }
  return density;
}

std::vector<Maximum> findMaxima(const std::vector<Eigen::Vector3f>& points, const VotingSettings& settings) {
  const PointGrid grid(points, settings.bandwidth);
  std::vector<PointGrid::Run> runs;
  std::vector<Maximum> climbed;
  for (std::size_t i = 0; i < grid.size(); ++i) climbed.push_back(climb(grid, settings, grid.point(i), runs));
  std::sort(climbed.begin(), climbed.end(), stronger);

  std::vector<Maximum> maxima;
  const float nearest = float(std::max(settings.suppression_radius, 10 * settings.tolerance));  // seeds of one maximum
  for (Maximum& candidate : climbed) {
    const bool suppressed = std::any_of(maxima.begin(), maxima.end(), [&](const Maximum& m) {
      return (m.position - candidate.position).norm() < nearest;
    });
    if (!suppressed) maxima.push_back(std::move(candidate));
  }
  for (Maximum& maximum : maxima) {
    grid.forEachNeighbor(maximum.position, float(settings.bandwidth), runs,
                         [&](std::uint32_t i, float) { maximum.votes.push_back(grid.source[i]); });
    std::sort(maximum.votes.begin(), maximum.votes.end());
  }
  const auto weak = [&](const Maximum& m) { return m.votes.size() < std::size_t(settings.min_votes); };
  maxima.erase(std::remove_if(maxima.begin(), maxima.end(), weak), maxima.end());
  return maxima;
}

}  // namespace sks
