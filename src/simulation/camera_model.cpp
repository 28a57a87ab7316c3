// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/simulation/camera_model.hpp>

#include <cmath>
#include <string>

#include <sks_detector/error.hpp>

namespace sks {

double axialSigma(double depth, double angle) {
  constexpr double steep = EIGEN_PI / 3, right = EIGEN_PI / 2;
  double sigma = 0.0012 + 0.0019 * (depth - 0.4) * (depth - 0.4);
  if (angle > steep && angle < right) {
    sigma += 0.0001 / std::sqrt(depth) * angle * angle / ((right - angle) * (right - angle));
  }
  return sigma;
}

double quantizeDepth(const CameraModel& camera, double depth) {
  const double scale = camera.fx * camera.baseline;  // depth times disparity
  const double steps = std::round(scale / depth / camera.noise.disparity_step);
  return steps > 0 ? scale / (steps * camera.noise.disparity_step) : std::nan("");
}

void validate(const CameraModel& camera) {
  const auto check = [](bool good, const std::string& name, double value, const std::string& range) {
    if (good) return;
    throw Error(ErrorCode::bad_usage, "camera: " + name + " = " + std::to_string(value) + " must be " + range);
  };
  constexpr int largest = 8192;
  check(camera.width > 0 && camera.width <= largest, "width", camera.width, "in [1, 8192] pixels");
  check(camera.height > 0 && camera.height <= largest, "height", camera.height, "in [1, 8192] pixels");
  const auto within = [&](const std::string& name, double value, double low, double high, const std::string& unit) {
    check(value >= low && value <= high, name, value,
          "in [" + std::to_string(long(low)) + ", " + std::to_string(long(high)) + "] " + unit);
  };
  within("fx", camera.fx, 1, 100000, "pixels");
  within("fy", camera.fy, 1, 100000, "pixels");
  within("cx", camera.cx, -100000, 100000, "pixels");
  within("cy", camera.cy, -100000, 100000, "pixels");
  within("min_range", camera.min_range, 0, 1000, "m");
  within("max_range", camera.max_range, 0, 1000, "m");
  check(camera.max_range > camera.min_range, "max_range", camera.max_range, "greater than min_range");
  within("baseline", camera.baseline, 0, 100, "m");
  check(camera.baseline > 0 || !(camera.noise.disparity || camera.noise.shadow), "baseline", camera.baseline,
        "greater than 0 m for disparity steps and shadows");
  within("disparity_step", camera.noise.disparity_step, 0, 1000, "pixels");
  check(camera.noise.disparity_step > 0 || !camera.noise.disparity, "disparity_step", camera.noise.disparity_step,
        "greater than 0 pixels");
  within("lateral_sigma", camera.noise.lateral_sigma, 0, 1000, "pixels");
  check(camera.noise.grazing_from < camera.noise.grazing_to, "grazing_from", camera.noise.grazing_from,
        "less than grazing_to");
}

}  // namespace sks
