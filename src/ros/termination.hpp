// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace sks_detector {

/// Lets SIGINT (Ctrl-C), SIGTERM and `rosnode kill` end spinUntilTermination() instead of shutting ROS down at once:
/// what must speak to end well, like the bonds of nodelets, still can. It has some seconds: then ROS is shut down, so
/// that nothing waits for a master that is away any more, and at last the process is ended with status 1. To be called
/// once a node handle has started ROS, which was initialised with ros::init_options::NoSigintHandler.
void handleTermination();

/// Calls the callbacks of the global queue until the process is to end, never in the middle of one.
void spinUntilTermination();

}  // namespace sks_detector
