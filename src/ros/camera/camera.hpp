// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "ros/camera/camera_device.hpp"
#include "ros/camera/camera_settings.hpp"

namespace sks_detector {

enum class CameraState { connecting, idle, streaming, ended };

struct CameraStatus {
  CameraState state = CameraState::connecting;
  DeviceDescription device;  ///< the one in use, or the last one
  std::string error;         ///< why there is no device at the moment
  unsigned reconnects = 0;   ///< how often a device that was gone came back
  std::uint64_t frames = 0;  ///< given out so far
};

/// Keeps a camera running: opens it, reads it in a thread of its own while frames are wanted, and opens it again, with
/// growing pauses, when it is gone. Safe to use from several threads.
class Camera {
public:
  /// Opens the device. @throws sks::Error saying why it cannot
  using Open = std::function<std::unique_ptr<CameraDevice>()>;
  /// Both are called from the camera's thread; nothing that they throw leaves it.
  using OnFrame = std::function<void(const CameraFrame&)>;
  using OnEvent = std::function<void(bool problem, const std::string& message)>;

  /// Opens the device in the background.
  Camera(const CameraSettings& settings, Open open, OnFrame on_frame, OnEvent on_event);
  /// Closes the device; no function is called any more afterwards.
  ~Camera();
  Camera(const Camera&) = delete;
  Camera& operator=(const Camera&) = delete;

  /// Whether somebody wants frames; otherwise the device is kept open but its streams are stopped.
  void setWanted(bool wanted);

  CameraStatus status() const;

private:
  using Clock = std::chrono::steady_clock;

  void run();
  void step();
  void open();
  void readFrame();
  void lose(const std::string& reason);
  void pause(std::chrono::duration<double> longest);
  void report(bool problem, const std::string& message);
  bool wanted() const;

  const CameraSettings settings_;
  const Open open_;
  const OnFrame on_frame_;
  const OnEvent on_event_;

  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  CameraStatus status_;
  bool wanted_ = false;
  bool stopping_ = false;

  std::unique_ptr<CameraDevice> device_;  // of the thread, like what follows
  bool streaming_ = false;
  bool was_open_ = false;
  double retry_delay_;
  CameraFrame frame_;
  Clock::time_point last_frame_;
  std::thread thread_;  // last: uses all of the above
};

}  // namespace sks_detector
