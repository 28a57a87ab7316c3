// SPDX-License-Identifier: BSD-3-Clause
#include "core/surface/orientation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace sks {
namespace {

constexpr int direction_count = 96;
constexpr float least_pixel = 1e-6f;       // [m] of points so near to each other that squares of distances vanish
constexpr double pixel_per_spacing = 2.5;  // wide enough that the far side does not show through between points

/// Median distance of a sample of points to their nearest neighbour.
float pointSpacing(const Surface& surface) {
  const std::size_t step = std::max<std::size_t>(1, surface.size() / 500);
  std::vector<float> nearest;
  const Eigen::Map<const Eigen::ArrayXf> x(surface.x.data(), surface.size()), y(surface.y.data(), surface.size()),
      z(surface.z.data(), surface.size());
  for (std::size_t i = 0; i < surface.size(); i += step) {
    const Eigen::Vector3f p = surface.point(i);
    Eigen::ArrayXf squared = (x - p.x()).square() + (y - p.y()).square() + (z - p.z()).square();
    squared[i] = std::numeric_limits<float>::infinity();
    nearest.push_back(std::sqrt(squared.minCoeff()));
  }
  std::nth_element(nearest.begin(), nearest.begin() + nearest.size() / 2, nearest.end());
  return nearest[nearest.size() / 2];
}

/// Evenly spread unit vectors (Fibonacci lattice).
std::vector<Eigen::Vector3f> spreadDirections(int count) {
  std::vector<Eigen::Vector3f> directions;
  const double golden_angle = M_PI * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count, r = std::sqrt(1.0 - z * z);
    directions.emplace_back(float(r * std::cos(golden_angle * i)), float(r * std::sin(golden_angle * i)), float(z));
  }
  return directions;
}

/// Whether each point is seen in an orthographic view from far away in `direction`.
std::vector<char> visibleFrom(const Surface& surface, const Eigen::Vector3f& direction, float pixel) {
  const Eigen::Vector3f u = direction.unitOrthogonal(), v = direction.cross(u);
  const std::size_t n = surface.size();
  std::vector<Eigen::Vector2f> image(n);
  std::vector<float> height(n);
  Eigen::Vector2f low = Eigen::Vector2f::Constant(std::numeric_limits<float>::max()), high = -low;
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3f p = surface.point(i);
    image[i] = {p.dot(u), p.dot(v)};
    height[i] = p.dot(direction);
    low = low.cwiseMin(image[i]);
    high = high.cwiseMax(image[i]);
  }
  pixel = std::max({pixel, (high - low).maxCoeff() / 2000.0f, least_pixel});
  const int width = int((high.x() - low.x()) / pixel) + 1, rows = int((high.y() - low.y()) / pixel) + 1;
  std::vector<float> top(std::size_t(width) * rows, -std::numeric_limits<float>::infinity());
  const auto cell = [&](std::size_t i) {
    const int column = std::min(int((image[i].x() - low.x()) / pixel), width - 1);
    const int row = std::min(int((image[i].y() - low.y()) / pixel), rows - 1);
    return std::size_t(row) * width + column;
  };
  for (std::size_t i = 0; i < n; ++i) top[cell(i)] = std::max(top[cell(i)], height[i]);
  std::vector<char> visible(n);
  for (std::size_t i = 0; i < n; ++i) visible[i] = height[i] >= top[cell(i)] - pixel;
  return visible;
}

}  // namespace

void orientOutward(Surface& surface, int threads) {
  const std::size_t n = surface.size();
  if (n < 2) return;
  const float pixel = float(pixel_per_spacing) * pointSpacing(surface);
  const auto directions = spreadDirections(direction_count);
  std::vector<std::vector<char>> visible(directions.size());
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::size_t k = 0; k < directions.size(); ++k) visible[k] = visibleFrom(surface, directions[k], pixel);

  std::vector<float> vote(n, 0.0f);  // > 0: the normal points to where the point is seen from
  for (std::size_t k = 0; k < directions.size(); ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      if (visible[k][i]) vote[i] += surface.normal(i).dot(directions[k]);
    }
  }
  std::vector<PointGrid::Run> runs;
  std::vector<float> sign(n, 1.0f);
  for (std::size_t i = 0; i < n; ++i) {
    if (!std::isfinite(vote[i])) continue;
    const Eigen::Vector3f normal = surface.normal(i);
    float sum = vote[i];
    surface.forEachNeighbor(surface.point(i), 2.0f * pixel, runs, [&](std::uint32_t j, float) {
      const float aligned = normal.dot(surface.normal(j));
      if (std::isfinite(vote[j])) sum += aligned * std::abs(aligned) * vote[j];
    });
    if (sum < 0) sign[i] = -1.0f;
  }
  for (std::size_t i = 0; i < n; ++i) {
    surface.nx[i] *= sign[i];
    surface.ny[i] *= sign[i];
    surface.nz[i] *= sign[i];
  }
}

}  // namespace sks
