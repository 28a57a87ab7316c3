// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/color_errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "simulation/noise_field.hpp"
#include "simulation/pixel_random.hpp"

namespace sks {
namespace {

constexpr std::uint64_t color_stream = ~std::uint64_t(1);  // of random numbers: that of pictures, not of pixels
constexpr std::uint64_t first_field = 8;                   // of noise: three of them
constexpr double noise_kernel = 0.6;                       // of demosaicing, measured on recordings [px]

double drawn(PixelRandom& random, double low, double high) {
  return low + (high - low) * random.uniform();
}

float linearOf(std::uint8_t value) {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      const float c = float(i) / 255;
      values[i] = c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
    }
    return values;
  }();
  return table[value];
}

float encoded(float linear) {
  const float c = std::clamp(linear, 0.0f, 1.0f);
  return 255 * (c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f);
}

/// A Gaussian blur along rows or columns, without what is black: there is nothing. The border is repeated.
void blurAlong(std::vector<Eigen::Vector3f>& image, int width, int height, double sigma, bool rows, int threads) {
  const int radius = int(std::ceil(3 * sigma)), length = rows ? width : height, lines = rows ? height : width;
  std::vector<float> kernel;
  for (int k = -radius; k <= radius; ++k) kernel.push_back(float(std::exp(-0.5 * k * k / (sigma * sigma))));
  const int step = rows ? 1 : width;
#pragma omp parallel for num_threads(threads)
  for (int line = 0; line < lines; ++line) {
    Eigen::Vector3f* first = image.data() + std::ptrdiff_t(line) * (rows ? width : 1);
    std::vector<Eigen::Vector3f> copy;
    for (int i = 0; i < length; ++i) copy.push_back(first[std::ptrdiff_t(i) * step]);
    for (int i = 0; i < length; ++i) {
      if (copy[std::size_t(i)].isZero(0)) continue;
      Eigen::Vector3f mean = Eigen::Vector3f::Zero();
      float sum = 0;
      for (int k = -radius; k <= radius; ++k) {
        const Eigen::Vector3f& other = copy[std::size_t(std::clamp(i + k, 0, length - 1))];
        if (other.isZero(0)) continue;
        mean += kernel[std::size_t(k + radius)] * other;
        sum += kernel[std::size_t(k + radius)];
      }
      first[std::ptrdiff_t(i) * step] = mean / sum;
    }
  }
}

}  // namespace

ColorDraw::ColorDraw(const ColorErrors& errors, std::uint64_t seed, std::uint64_t frame) {
  PixelRandom random(seed, frame, color_stream);
  const double exposure = drawn(random, errors.min_exposure, errors.max_exposure);
  const double red = drawn(random, errors.min_red, errors.max_red);
  const double blue = drawn(random, errors.min_blue, errors.max_blue);
  gain = Eigen::Vector3d(std::exp2(exposure + red), std::exp2(exposure), std::exp2(exposure + blue)).cast<float>();
  const double azimuth = drawn(random, 0, 2 * EIGEN_PI), elevation = drawn(random, 0.6, 1.3);  // 35 to 75 degrees
  to_light = Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                             std::sin(elevation))
                 .cast<float>();
  offset.x() = drawn(random, -errors.offset, errors.offset);
  offset.y() = drawn(random, -errors.offset, errors.offset);
}

Eigen::Vector3f toLinear(const Rgb& color) {
  return {linearOf(color.r), linearOf(color.g), linearOf(color.b)};
}

std::vector<Rgb> developPicture(std::vector<Eigen::Vector3f> light, const CameraModel& camera, const ColorDraw& draw,
                                std::uint64_t frame, int threads) {
  const ColorErrors& errors = camera.color;
  if (errors.blur > 0) {
    blurAlong(light, camera.width, camera.height, errors.blur, true, threads);
    blurAlong(light, camera.width, camera.height, errors.blur, false, threads);
  }
  std::array<std::vector<float>, 3> noise;
  const std::array<double, 3> sigma{errors.noise_red, errors.noise_green, errors.noise_blue};
  for (std::size_t c = 0; c < 3; ++c) {
    if (sigma[c] <= 0) continue;
    noise[c] =
        NoiseField{camera.width, camera.height, noise_kernel, noise_kernel, camera.noise.seed, frame, first_field + c}
            .values(threads);
  }
  std::vector<Rgb> picture(light.size());
  const float half_diagonal = 0.5f * std::hypot(float(camera.width), float(camera.height));
#pragma omp parallel for num_threads(threads)
  for (int row = 0; row < camera.height; ++row) {
    for (int column = 0; column < camera.width; ++column) {
      const std::size_t pixel = std::size_t(row) * std::size_t(camera.width) + std::size_t(column);
      const float off =
          std::hypot(float(column) - 0.5f * float(camera.width), float(row) - 0.5f * float(camera.height)) /
          half_diagonal;
      const float bright = 1 - float(errors.vignetting) * off * off;
      std::array<std::uint8_t, 3> value{};
      for (std::size_t c = 0; c < 3; ++c) {
        float level = encoded(bright * draw.gain[Eigen::Index(c)] * light[pixel][Eigen::Index(c)]);
        if (!noise[c].empty()) level += float(sigma[c]) * noise[c][pixel];
        value[c] = std::uint8_t(std::lround(std::clamp(level, 0.0f, 255.0f)));
      }
      picture[pixel] = {value[0], value[1], value[2]};
    }
  }
  return picture;
}

}  // namespace sks
