// SPDX-License-Identifier: BSD-3-Clause
#include <exception>
#include <memory>

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "ros/detector_node.hpp"

namespace sks_detector {

class DetectorNodelet : public nodelet::Nodelet {
  void onInit() override {
    try {
      node_ = std::make_unique<DetectorNode>(getPrivateNodeHandle());
    } catch (const std::exception& error) {  // would take the manager and its other nodelets with it
      NODELET_FATAL("the detector does not start: %s", error.what());
    }
  }

  std::unique_ptr<DetectorNode> node_;
};

}  // namespace sks_detector

PLUGINLIB_EXPORT_CLASS(sks_detector::DetectorNodelet, nodelet::Nodelet)
