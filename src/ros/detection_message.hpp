// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/Pose.h>
#include <sks_detector/Detection.h>
#include <sks_detector/detection.hpp>

namespace sks_detector {

geometry_msgs::Pose toMessage(const Eigen::Isometry3d& pose);

/// What the core found, as a message; a covariance of zeros: not known.
Detection toMessage(const sks::Detection& detection);

/// The other way round. A pose or box whose quaternion is zero was never set: the one stands in for the other.
/// @throws sks::Error(bad_data) naming the object where a number is not finite or neither is set
sks::Detection toDetection(const Detection& message);

}  // namespace sks_detector
