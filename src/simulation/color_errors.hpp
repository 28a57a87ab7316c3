// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <sks_detector/cloud.hpp>
#include <sks_detector/simulation/camera_model.hpp>

namespace sks {

/// What one picture's exposure, white balance, light and registration are: drawn from the ranges of ColorErrors.
struct ColorDraw {
  Eigen::Vector3f gain = Eigen::Vector3f::Ones();       ///< of the three channels, linear
  Eigen::Vector3f to_light = Eigen::Vector3f::UnitZ();  ///< direction of the light in the world, z upwards
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();     ///< of the colour picture against the depth picture [px]

  ColorDraw(const ColorErrors& errors, std::uint64_t seed, std::uint64_t frame);
};

/// Linear light of an sRGB colour, 0 to 1.
Eigen::Vector3f toLinear(const Rgb& color);

/// The picture that the camera makes of the light that comes in: blur, vignetting, exposure, white balance, noise.
/// @param light linear, one for each pixel, row-major
std::vector<Rgb> developPicture(std::vector<Eigen::Vector3f> light, const CameraModel& camera, const ColorDraw& draw,
                                std::uint64_t frame, int threads);

}  // namespace sks
