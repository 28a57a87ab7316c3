// SPDX-License-Identifier: BSD-3-Clause
#include "ros/with_queue.hpp"

namespace sks_detector {

ros::NodeHandle withQueue(ros::NodeHandle handle, ros::CallbackQueue& queue) {
  handle.setCallbackQueue(&queue);
  return handle;
}

}  // namespace sks_detector
