// SPDX-License-Identifier: BSD-3-Clause
#include "ros/camera/device_watch.hpp"

namespace sks_detector {

DeviceWatch::DeviceWatch(const std::string& uri) : uri_(uri) {
  openni::OpenNI::addDeviceDisconnectedListener(this);
  openni::OpenNI::addDeviceStateChangedListener(this);
}

DeviceWatch::~DeviceWatch() {
  openni::OpenNI::removeDeviceStateChangedListener(this);
  openni::OpenNI::removeDeviceDisconnectedListener(this);
}

void DeviceWatch::onDeviceDisconnected(const openni::DeviceInfo* info) {
  if (uri_ == info->getUri()) connected_ = false;
}

void DeviceWatch::onDeviceStateChanged(const openni::DeviceInfo* info, openni::DeviceState state) {
  if (uri_ != info->getUri()) return;
  if (state == openni::DEVICE_STATE_EOF) recording_ended_ = true;
  if (state == openni::DEVICE_STATE_ERROR) connected_ = false;
}

}  // namespace sks_detector
