// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "ros/camera/camera_frame.hpp"
#include "ros/camera/video_mode.hpp"

namespace sks_detector {

/// What was opened and how it was set up.
struct DeviceDescription {
  std::string name;    ///< vendor and product, or the file that is played
  std::string uri;     ///< of OpenNI2
  std::string serial;  ///< empty where the device has none
  VideoMode depth_mode;
  VideoMode color_mode;  ///< of no width where there is no colour
  bool registered = false;
  bool recording = false;
  Intrinsics intrinsics;             ///< of the depth image
  std::vector<std::string> remarks;  ///< what differs from what was asked for
};

enum class ReadResult { frame, nothing_yet, recording_ended };

/// An open RGB-D camera or recording; to be used from one thread. Where it is gone, each call may throw sks::Error.
class CameraDevice {
public:
  virtual ~CameraDevice() = default;

  virtual const DeviceDescription& description() const = 0;

  /// Lets images come in. @throws sks::Error with the driver's reason
  virtual void start() = 0;
  virtual void stop() = 0;

  /// Waits for the next frame. @throws sks::Error(bad_data) when the device is gone
  virtual ReadResult read(CameraFrame& frame, std::chrono::milliseconds timeout) = 0;

  /// False once the device was unplugged, as far as the driver tells.
  virtual bool connected() const = 0;
};

}  // namespace sks_detector
