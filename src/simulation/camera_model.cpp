// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/simulation/camera_model.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include <sks_detector/error.hpp>

namespace sks {

bool ColorErrors::any() const {
  const double all[] = {min_exposure, max_exposure, min_red,   max_red,     min_blue,   max_blue, light,
                        vignetting,   blur,         noise_red, noise_green, noise_blue, offset};
  return std::any_of(std::begin(all), std::end(all), [](double value) { return value != 0; });
}

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
  within("disparity_sigma", camera.noise.disparity_sigma, 0, 100, "pixels");
  check(camera.baseline > 0 || camera.noise.disparity_sigma == 0, "baseline", camera.baseline,
        "greater than 0 m for errors of the disparity");
  within("correlation_x", camera.noise.correlation_x, 0, 100, "pixels");
  within("correlation_y", camera.noise.correlation_y, 0, 100, "pixels");
  within("depth_step", camera.noise.depth_step, 0, 1, "m");
  within("edge_loss", camera.noise.edge_loss, 0, 100, "pixels");
  const ColorErrors& color = camera.color;
  for (const double stops :
       {color.min_exposure, color.max_exposure, color.min_red, color.max_red, color.min_blue, color.max_blue}) {
    within("exposure and white balance", stops, -10, 10, "stops");
  }
  within("light", color.light, 0, 1, "");
  within("vignetting", color.vignetting, 0, 1, "");
  within("blur", color.blur, 0, 100, "pixels");
  for (const double sigma : {color.noise_red, color.noise_green, color.noise_blue}) {
    within("colour noise", sigma, 0, 255, "levels");
  }
  within("offset of the colours", color.offset, 0, 100, "pixels");
}

}  // namespace sks
