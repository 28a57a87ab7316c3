// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/depth_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulation/noise_field.hpp"

namespace sks {
namespace {

constexpr float edge_step = 0.03f;   // in depth, as a share of it
constexpr double patch_size = 4;     // sigma of the patches without depth [px]
constexpr double dark_level = 40;    // of the brightest channel, of 255, below which depth is lost now and then
constexpr double dark_share = 0.5;   // of what is black
constexpr double edge_ragged = 0.3;  // sigma of edge_loss, as a share of it

/// Probability that a standard normal number is smaller.
double normalShare(double value) {
  return 0.5 * std::erfc(-value / std::sqrt(2.0));
}

}  // namespace

bool isEdge(float depth, float other) {
  return std::abs(depth - other) > edge_step * std::min(depth, other);
}

DepthErrors::DepthErrors(const CameraModel& camera, std::uint64_t frame, int threads) : camera_(camera) {
  const CameraNoise& noise = camera.noise;
  const auto field = [&](double sigma_x, double sigma_y, std::uint64_t stream) {
    return NoiseField{camera.width, camera.height, sigma_x, sigma_y, noise.seed, frame, stream}.values(threads);
  };
  if (smooth()) {
    disparity_ = field(noise.correlation_x, noise.correlation_y, 0);
    if (noise.lateral) {
      aside_ = field(noise.correlation_x, noise.correlation_y, 1);
      down_ = field(noise.correlation_x, noise.correlation_y, 2);
    }
  }
  if (noise.dark || noise.grazing || noise.edge_loss > 0) patches_ = field(patch_size, patch_size, 3);
}

Eigen::Vector2d DepthErrors::lateral(std::size_t pixel, PixelRandom& random) const {
  if (!camera_.noise.lateral) {
    random.skip(2);
    return Eigen::Vector2d::Zero();
  }
  const auto [aside, down] = random.normal();
  const double sigma = camera_.noise.lateral_sigma;
  return aside_.empty() ? Eigen::Vector2d(sigma * aside, sigma * down)
                        : Eigen::Vector2d(sigma * double(aside_[pixel]), sigma * double(down_[pixel]));
}

double DepthErrors::measured(const SeenSurface& surface, std::size_t pixel, PixelRandom& random) const {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const CameraNoise& noise = camera_.noise;
  const double angle = std::acos(double(surface.cosine)), degrees = angle * 180 / EIGEN_PI;
  const double luck = random.uniform();
  if (noise.grazing && luck < (degrees - noise.grazing_from) / (noise.grazing_to - noise.grazing_from)) return nan;
  if (noise.grazing || noise.dark) {
    double share = noise.grazing ? surface.lost : 0;
    if (noise.dark) {
      const double level = std::max({surface.color.r, surface.color.g, surface.color.b});
      share = std::max(share, dark_share * (1 - level / dark_level) * (1.5 - double(surface.cosine)));
    }
    if (share > 0 && normalShare(double(patches_[pixel])) < share) return nan;
  }
  double depth = surface.depth;
  const double scale = camera_.fx * camera_.baseline;  // depth times disparity
  if (smooth()) {
    depth = scale / std::max(1e-3, scale / depth + noise.disparity_sigma * double(disparity_[pixel]));
  } else if (noise.axial) {
    double variance = std::pow(axialSigma(depth, angle), 2);
    if (noise.disparity) {  // the steps that come on top were in what the model was fitted to
      const double step = depth * depth * noise.disparity_step / scale;
      variance = std::max(0.0, variance - step * step / 12);
    }
    depth += random.normal().first * std::sqrt(variance);
  }
  if (noise.disparity) depth = quantizeDepth(camera_, depth);
  return noise.depth_step > 0 ? noise.depth_step * std::round(depth / noise.depth_step) : depth;
}

void DepthErrors::loseEdges(const std::vector<float>& depth, std::vector<Eigen::Vector3f>& points, int threads) const {
  const double loss = camera_.noise.edge_loss;
  const int reach = int(std::ceil(loss * (1 + 2 * edge_ragged)));
#pragma omp parallel for num_threads(threads)
  for (int row = 0; row < camera_.height; ++row) {
    for (int column = 0; column < camera_.width; ++column) {
      const std::size_t pixel = std::size_t(row) * std::size_t(camera_.width) + std::size_t(column);
      if (!points[pixel].allFinite()) continue;
      const double near = loss * (1 + edge_ragged * double(patches_[pixel]));
      bool lost = false;
      for (int y = std::max(0, row - reach); y <= std::min(camera_.height - 1, row + reach) && !lost; ++y) {
        for (int x = std::max(0, column - reach); x <= std::min(camera_.width - 1, column + reach) && !lost; ++x) {
          if (std::hypot(x - column, y - row) > near) continue;
          lost = isEdge(depth[pixel], depth[std::size_t(y) * std::size_t(camera_.width) + std::size_t(x)]);
        }
      }
      if (lost) points[pixel].setConstant(std::numeric_limits<float>::quiet_NaN());
    }
  }
}

}  // namespace sks
