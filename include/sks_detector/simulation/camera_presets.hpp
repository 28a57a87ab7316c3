// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <sks_detector/simulation/camera_model.hpp>

namespace sks {

/// A virtual camera by its name: ideal (no errors), basic (independent errors in depth, true colours; the default of
/// CameraModel), kinect, xtion (structured light), realsense (stereo, D435). The last three were set by recordings:
/// standard deviation and correlation of what planes leave (docs/simulation.md).
/// @throws Error(bad_usage) naming those that exist
CameraModel cameraPreset(const std::string& name);

}  // namespace sks
