// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mutex>

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <sks_detector/ObjectModels.h>

#include "ros/detector_slot.hpp"

namespace sks_detector {

/// `~models`, latched: what the objects look like. Made once somebody has subscribed, and again when the codebook
/// changes. Safe to use from several threads.
class ModelOutput {
public:
  /// @param slot whose codebook is in use; must live longer
  ModelOutput(ros::NodeHandle& private_handle, const DetectorSlot& slot);

  /// To be called when the codebook in use has changed.
  void codebookChanged();

private:
  void subscribed();
  void publish();

  const DetectorSlot& slot_;
  std::mutex mutex_;     // nobody gets an older codebook after a newer one
  bool wanted_ = false;  // by somebody since the start
  ros::Publisher publisher_;
};

}  // namespace sks_detector
