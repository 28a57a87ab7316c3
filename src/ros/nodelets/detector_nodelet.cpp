// SPDX-License-Identifier: BSD-3-Clause
#include <exception>
#include <memory>
#include <thread>

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "ros/detector_node.hpp"

namespace sks_detector {

class DetectorNodelet : public nodelet::Nodelet {
public:
  ~DetectorNodelet() override {
    if (starting_.joinable()) starting_.join();
  }

private:
  /// Returns at once: a manager does not survive to be interrupted while it loads a nodelet, and codebooks take time.
  void onInit() override {
    starting_ = std::thread([this] { start(); });
  }

  void start() {
    try {
      node_ = std::make_unique<DetectorNode>(getPrivateNodeHandle());
    } catch (const std::exception& error) {  // would take the manager and its other nodelets with it
      NODELET_FATAL("the detector does not start: %s", error.what());
    }
  }

  std::unique_ptr<DetectorNode> node_;
  std::thread starting_;
};

}  // namespace sks_detector

PLUGINLIB_EXPORT_CLASS(sks_detector::DetectorNodelet, nodelet::Nodelet)
