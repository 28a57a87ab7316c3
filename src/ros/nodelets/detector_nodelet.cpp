// SPDX-License-Identifier: BSD-3-Clause
#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

namespace sks_detector {

class DetectorNodelet : public nodelet::Nodelet {
  void onInit() override {}
};

}  // namespace sks_detector

PLUGINLIB_EXPORT_CLASS(sks_detector::DetectorNodelet, nodelet::Nodelet)
