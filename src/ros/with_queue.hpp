// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>

namespace sks_detector {

/// A handle of the same namespace whose callbacks go to `queue`, which must live longer.
ros::NodeHandle withQueue(ros::NodeHandle handle, ros::CallbackQueue& queue);

}  // namespace sks_detector
