// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <string>

#include <OpenNI.h>

namespace sks_detector {

/// Remembers what OpenNI2 reports of one device from threads of its own.
class DeviceWatch : openni::OpenNI::DeviceDisconnectedListener, openni::OpenNI::DeviceStateChangedListener {
public:
  explicit DeviceWatch(const std::string& uri);
  ~DeviceWatch() override;
  DeviceWatch(const DeviceWatch&) = delete;
  DeviceWatch& operator=(const DeviceWatch&) = delete;

  bool connected() const { return connected_; }
  bool recordingEnded() const { return recording_ended_; }

private:
  void onDeviceDisconnected(const openni::DeviceInfo* info) override;
  void onDeviceStateChanged(const openni::DeviceInfo* info, openni::DeviceState state) override;

  const std::string uri_;
  std::atomic<bool> connected_{true};
  std::atomic<bool> recording_ended_{false};
};

}  // namespace sks_detector
