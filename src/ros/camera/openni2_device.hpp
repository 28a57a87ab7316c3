// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include <OpenNI.h>

#include "ros/camera/camera_device.hpp"
#include "ros/camera/camera_settings.hpp"
#include "ros/camera/frame_pairs.hpp"
#include "ros/camera/openni2_library.hpp"

namespace sks_detector {

class DeviceWatch;

/// A camera or recording through OpenNI2.
class OpenNi2Device : public CameraDevice {
public:
  /// Opens the device and sets it up. @throws sks::Error naming the device, the reason and a remedy
  explicit OpenNi2Device(const CameraSettings& settings);
  ~OpenNi2Device() override;

  const DeviceDescription& description() const override { return description_; }
  void start() override;
  void stop() override;
  ReadResult read(CameraFrame& frame, std::chrono::milliseconds timeout) override;
  bool connected() const override;

private:
  void openStreams(const CameraSettings& settings);
  void setUpColor(const CameraSettings& settings);
  void describe(const CameraSettings& settings);
  bool hasColor() const { return description_.color_mode.width > 0; }
  void readStream(openni::VideoStream& stream, bool is_depth);
  bool take(CameraFrame& frame);

  std::shared_ptr<OpenNi2Library> library_;  // first: outlives what follows
  openni::Device device_;
  openni::VideoStream depth_;
  openni::VideoStream color_;
  std::unique_ptr<DeviceWatch> watch_;
  DeviceDescription description_;
  std::unique_ptr<FramePairs> pairs_;
  DepthImage newest_depth_;  // without colour it is the frame
  bool running_ = false;
};

}  // namespace sks_detector
