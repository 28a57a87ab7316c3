// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "ros/node_settings.hpp"

namespace sks_detector {

/// The frame of a detection on /tf, by ~tf_prefix and ~tf_frame: "mug", "mug_2" or "left/mug_1", for example.
/// @param number of the object in its cloud, from 1
std::string detectionFrame(const NodeSettings& settings, const std::string& object, int number);

/// @throws sks::Error(bad_usage) where a pattern as of ~tf_frame would give two objects one name, or has a placeholder
/// that is unknown
void checkFramePattern(const std::string& pattern);

}  // namespace sks_detector
