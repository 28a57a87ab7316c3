// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <sks_detector/Support.h>
#include <std_msgs/Header.h>
#include <Eigen/Geometry>

#include <sks_detector/support.hpp>

namespace sks_detector {

/// What things stand on, in the frame of the header; `found` is false where there is nothing.
Support toMessage(const std::optional<sks::Support>& support, const Eigen::Isometry3d& T_target_cloud,
                  const std_msgs::Header& header);

}  // namespace sks_detector
