// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <csignal>

#include <ros/init.h>

namespace sks_detector {

/// Lets SIGTERM end the node as Ctrl-C does, and not on the spot. To be called once ROS has been started: a request to
/// shut down that comes before is forgotten.
inline void shutDownOnTermination() {
  std::signal(SIGTERM, [](int) { ros::requestShutdown(); });
}

}  // namespace sks_detector
