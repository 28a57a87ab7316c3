// SPDX-License-Identifier: BSD-3-Clause
#include "ros/camera/camera.hpp"

#include <algorithm>
#include <utility>

#include <sks_detector/error.hpp>

#include "core/settings/value_text.hpp"

namespace sks_detector {
namespace {

constexpr std::chrono::milliseconds poll_time(100);  // longest time until a change is noticed

std::string describe(const DeviceDescription& device) {
  std::string text = device.name + " (" + device.uri + ")";
  if (device.recording) text = "recording " + device.name;
  text += ", depth " + toText(device.depth_mode);
  if (device.color_mode.width == 0) return text + ", no colour";
  return text + ", colour " + toText(device.color_mode) + (device.registered ? ", registered" : ", not registered");
}

}  // namespace

Camera::Camera(const CameraSettings& settings, Open open, OnFrame on_frame, OnEvent on_event)
    : settings_(settings),
      open_(std::move(open)),
      on_frame_(std::move(on_frame)),
      on_event_(std::move(on_event)),
      retry_delay_(settings.retry_delay),
      thread_([this] { run(); }) {}

Camera::~Camera() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Camera::setWanted(bool wanted) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    wanted_ = wanted;
  }
  changed_.notify_all();
}

CameraStatus Camera::status() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return status_;
}

bool Camera::wanted() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return wanted_;
}

void Camera::run() {
  while (true) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (stopping_) break;
    }
    try {
      step();
    } catch (const std::exception& error) {
      lose(error.what());
    }
  }
  device_.reset();
}

void Camera::step() {
  if (!device_) return open();
  if (status().state == CameraState::ended) return pause(poll_time);
  if (streaming_ != wanted()) {
    streaming_ = !streaming_;
    streaming_ ? device_->start() : device_->stop();
    last_frame_ = Clock::now();
    const std::lock_guard<std::mutex> lock(mutex_);
    status_.state = streaming_ ? CameraState::streaming : CameraState::idle;
  } else if (streaming_) {
    readFrame();
  } else if (!device_->connected()) {
    throw sks::Error(sks::ErrorCode::bad_data, "it was disconnected");
  } else {
    pause(poll_time);
  }
}

void Camera::open() {
  device_ = open_();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    status_.state = CameraState::idle;
    status_.device = device_->description();
    status_.error.clear();
    if (was_open_) ++status_.reconnects;
  }
  retry_delay_ = settings_.retry_delay;
  report(false, (was_open_ ? "Camera is back: " : "Camera: ") + describe(device_->description()));
  if (!was_open_) {
    for (const std::string& remark : device_->description().remarks) report(true, "Camera: " + remark);
  }
  was_open_ = true;
}

void Camera::readFrame() {
  const ReadResult result = device_->read(frame_, poll_time);
  if (result == ReadResult::frame) {
    last_frame_ = Clock::now();
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      ++status_.frames;
    }
    on_frame_(frame_);
  } else if (result == ReadResult::recording_ended) {
    device_->stop();
    streaming_ = false;
    report(false, "Camera: the recording has ended");
    const std::lock_guard<std::mutex> lock(mutex_);
    status_.state = CameraState::ended;
  } else if (Clock::now() - last_frame_ > std::chrono::duration<double>(settings_.frame_timeout)) {
    throw sks::Error(sks::ErrorCode::bad_data,
                     "no frame for " + sks::toText(settings_.frame_timeout) + " s (~frame_timeout)");
  }
}

void Camera::lose(const std::string& reason) {
  const bool had_device = device_ != nullptr;
  device_.reset();
  streaming_ = false;
  bool first = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    first = had_device || status_.error != reason;
    status_.state = CameraState::connecting;
    status_.error = reason;
  }
  if (first) {
    report(true, (had_device ? "Camera is gone: " : "Camera: ") + reason + "; trying again until it is there");
  }
  pause(std::chrono::duration<double>(retry_delay_));
  retry_delay_ = std::min(2 * retry_delay_, std::max(settings_.max_retry_delay, settings_.retry_delay));
}

void Camera::pause(std::chrono::duration<double> longest) {
  std::unique_lock<std::mutex> lock(mutex_);
  const bool wanted_before = wanted_;
  changed_.wait_for(lock, longest, [&] { return stopping_ || (device_ && wanted_ != wanted_before); });
}

void Camera::report(bool problem, const std::string& message) {
  on_event_(problem, message);
}

}  // namespace sks_detector
