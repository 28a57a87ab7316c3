// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "ros/camera/camera_node.hpp"

namespace sks_detector {

class CameraNodelet : public nodelet::Nodelet {
  void onInit() override {
    try {
      node_ = std::make_unique<CameraNode>(getPrivateNodeHandle(), getName());
    } catch (const std::exception& error) {
      NODELET_FATAL("The camera cannot start: %s", error.what());
    }
  }

  std::unique_ptr<CameraNode> node_;
};

}  // namespace sks_detector

PLUGINLIB_EXPORT_CLASS(sks_detector::CameraNodelet, nodelet::Nodelet)
