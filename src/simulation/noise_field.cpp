// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/noise_field.hpp"

#include <cmath>
#include <cstddef>

#include "simulation/pixel_random.hpp"

namespace sks {
namespace {

/// Weights whose squares add up to 1, so that the variance stays.
std::vector<float> gaussianKernel(double sigma) {
  const int radius = int(std::ceil(3 * sigma));
  std::vector<float> kernel;
  double squares = 0;
  for (int k = -radius; k <= radius; ++k) {
    const double weight = sigma > 0 ? std::exp(-0.5 * k * k / (sigma * sigma)) : 1;
    kernel.push_back(float(weight));
    squares += weight * weight;
  }
  for (float& weight : kernel) weight = float(weight / std::sqrt(squares));
  return kernel;
}

}  // namespace

std::vector<float> NoiseField::values(int threads) const {
  const std::vector<float> across = gaussianKernel(sigma_x), down = gaussianKernel(sigma_y);
  const int wide = width + int(across.size()) - 1, high = height + int(down.size()) - 1;  // with a border
  std::vector<float> white(std::size_t(wide) * std::size_t(high)), rows(std::size_t(width) * std::size_t(high)),
      result(std::size_t(width) * std::size_t(height));
  const std::uint64_t first = (stream + 1) << 40;  // beyond the pixels that have random numbers of their own
#pragma omp parallel num_threads(threads)
  {
#pragma omp for
    for (int row = 0; row < high; ++row) {
      float* line = white.data() + std::size_t(row) * std::size_t(wide);
      for (int column = 0; column < wide; column += 2) {
        const auto [one, other] =
            PixelRandom(seed, frame, first + std::uint64_t(row) * std::uint64_t(wide) + std::uint64_t(column)).normal();
        line[column] = float(one);
        if (column + 1 < wide) line[column + 1] = float(other);
      }
      for (int column = 0; column < width; ++column) {
        float sum = 0;
        for (std::size_t k = 0; k < across.size(); ++k) sum += across[k] * line[std::size_t(column) + k];
        rows[std::size_t(row) * std::size_t(width) + std::size_t(column)] = sum;
      }
    }
#pragma omp for
    for (int row = 0; row < height; ++row) {
      for (int column = 0; column < width; ++column) {
        float sum = 0;
        for (std::size_t k = 0; k < down.size(); ++k) {
          sum += down[k] * rows[(std::size_t(row) + k) * std::size_t(width) + std::size_t(column)];
        }
        result[std::size_t(row) * std::size_t(width) + std::size_t(column)] = sum;
      }
    }
  }
  return result;
}

}  // namespace sks
