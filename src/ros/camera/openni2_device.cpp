// SPDX-License-Identifier: BSD-3-Clause
#include "ros/camera/openni2_device.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <thread>
#include <utility>

#include <sks_detector/error.hpp>

#include "core/settings/value_text.hpp"
#include "ros/camera/device_watch.hpp"
#include "ros/camera/openni2_images.hpp"

namespace sks_detector {
namespace {

using sks::Error;
using sks::ErrorCode;

void check(openni::Status status, const std::string& action) {
  if (status != openni::STATUS_OK) throw Error(ErrorCode::bad_data, "cannot " + action + ": " + openNi2Error());
}

VideoMode modeOf(const openni::VideoMode& mode) {
  return {mode.getResolutionX(), mode.getResolutionY(), double(mode.getFps())};
}

/// The modes of a sensor in the first of the formats that it has; empty if it has none.
std::vector<openni::VideoMode> modesOf(const openni::SensorInfo* sensor,
                                       std::initializer_list<openni::PixelFormat> formats) {
  std::vector<openni::VideoMode> result;
  if (sensor == nullptr) return result;
  const openni::Array<openni::VideoMode>& all = sensor->getSupportedVideoModes();
  for (const openni::PixelFormat format : formats) {
    for (int i = 0; i < all.getSize(); ++i) {
      if (all[i].getPixelFormat() == format) result.push_back(all[i]);
    }
    if (!result.empty()) break;
  }
  return result;
}

/// Creates a stream in the mode nearest to `wanted`; a recording comes in the mode that it was made in.
VideoMode openStream(openni::Device& device, openni::SensorType type, const std::vector<openni::VideoMode>& modes,
                     const VideoMode& wanted, openni::VideoStream& stream) {
  const std::string name = type == openni::SENSOR_DEPTH ? "depth" : "colour";
  check(stream.create(device, type), "open the " + name + " stream");
  if (stream.isPropertySupported(openni::STREAM_PROPERTY_MIRRORING)) stream.setMirroringEnabled(false);
  if (device.isFile()) return modeOf(stream.getVideoMode());
  std::vector<VideoMode> plain;
  std::transform(modes.begin(), modes.end(), std::back_inserter(plain), modeOf);
  const std::size_t best = nearestMode(plain, wanted);
  // Drivers with a single mode may know no setter.
  if (modes.size() > 1) check(stream.setVideoMode(modes[best]), "set " + name + " to " + toText(plain[best]));
  return plain[best];
}

}  // namespace

OpenNi2Device::OpenNi2Device(const CameraSettings& settings) : library_(OpenNi2Library::get()) {
  library_->open(settings.device, device_);
  description_.recording = device_.isFile();
  if (description_.recording) device_.getPlaybackControl()->setRepeatEnabled(settings.loop);
  watch_ = std::make_unique<DeviceWatch>(device_.getDeviceInfo().getUri());
  openStreams(settings);
  describe(settings);
  pairs_ = std::make_unique<FramePairs>(std::uint64_t(0.55e6 / std::max(description_.depth_mode.rate, 1.0)));
}

OpenNi2Device::~OpenNi2Device() {
  stop();
  depth_.destroy();
  color_.destroy();
  watch_.reset();
  device_.close();
}

void OpenNi2Device::openStreams(const CameraSettings& settings) {
  const auto modes = modesOf(device_.getSensorInfo(openni::SENSOR_DEPTH),
                             {openni::PIXEL_FORMAT_DEPTH_1_MM, openni::PIXEL_FORMAT_DEPTH_100_UM});
  if (modes.empty()) throw Error(ErrorCode::bad_data, "the device (~device) gives no depth images in millimetres");
  const VideoMode wanted{settings.width, settings.height, settings.rate};
  const VideoMode mode = openStream(device_, openni::SENSOR_DEPTH, modes, wanted, depth_);
  description_.depth_mode = mode;
  if (!description_.recording &&
      (mode.width != wanted.width || mode.height != wanted.height || mode.rate != wanted.rate)) {
    description_.remarks.push_back("it has no mode of " + toText(wanted) + ": the nearest, " + toText(mode) +
                                   ", is used (~width, ~height, ~rate)");
  }
  if (settings.color) setUpColor(settings);
}

void OpenNi2Device::setUpColor(const CameraSettings& settings) {
  const auto modes = modesOf(device_.getSensorInfo(openni::SENSOR_COLOR), {openni::PIXEL_FORMAT_RGB888});
  if (modes.empty()) {
    description_.remarks.emplace_back("it gives no colour images: clouds carry x, y and z only");
    return;
  }
  description_.color_mode = openStream(device_, openni::SENSOR_COLOR, modes, description_.depth_mode, color_);
  const auto registration = openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR;
  if (settings.registration && device_.isImageRegistrationModeSupported(registration)) {
    check(device_.setImageRegistrationMode(registration), "register depth to colour (~registration)");
    description_.registered = true;
  } else if (settings.registration && !description_.recording) {
    description_.remarks.emplace_back(
        "it does not register depth to colour: points near the camera get colours from beside them");
  }
  if (settings.sync && !description_.recording) device_.setDepthColorSyncEnabled(true);
}

void OpenNi2Device::describe(const CameraSettings& settings) {
  const openni::DeviceInfo& info = device_.getDeviceInfo();
  description_.uri = info.getUri();
  description_.serial = serialNumber(device_);
  description_.name = std::string(info.getVendor()) + " " + info.getName();
  if (description_.recording) description_.name = settings.device;

  // Registered depth is seen from the colour camera.
  const bool color_optics = description_.registered && color_.getHorizontalFieldOfView() > 0;
  const openni::VideoStream& optics = color_optics ? color_ : depth_;
  const VideoMode& mode = description_.depth_mode;
  const double angle = optics.getHorizontalFieldOfView();
  description_.intrinsics =
      withCalibration(intrinsicsFromFieldOfView(mode.width, mode.height, angle, optics.getVerticalFieldOfView()),
                      settings.focal_length, settings.center_x, settings.center_y);
  if (!(angle > 0) && settings.focal_length == 0) {
    description_.remarks.push_back("it tells no field of view: a focal length of " +
                                   sks::toText(description_.intrinsics.fx) + " px is assumed (set ~focal_length)");
  }
}

void OpenNi2Device::start() {
  if (running_) return;
  running_ = true;
  check(depth_.start(), "start the depth stream");
  if (hasColor()) check(color_.start(), "start the colour stream");
}

void OpenNi2Device::stop() {
  if (!running_) return;
  running_ = false;
  depth_.stop();
  if (hasColor()) color_.stop();
  pairs_->clear();
  newest_depth_ = {};
  // The threads of some drivers use the stream for one more frame.
  std::this_thread::sleep_for(std::chrono::duration<double>(2.0 / std::max(description_.depth_mode.rate, 10.0)));
}

bool OpenNi2Device::connected() const {
  return watch_->connected();
}

ReadResult OpenNi2Device::read(CameraFrame& frame, std::chrono::milliseconds timeout) {
  if (take(frame)) return ReadResult::frame;
  std::array<openni::VideoStream*, 2> streams{&depth_, &color_};
  int ready = 0;
  const openni::Status status =
      openni::OpenNI::waitForAnyStream(streams.data(), hasColor() ? 2 : 1, &ready, int(timeout.count()));
  if (!connected()) throw Error(ErrorCode::bad_data, "it was disconnected");
  if (status == openni::STATUS_TIME_OUT) {
    return watch_->recordingEnded() ? ReadResult::recording_ended : ReadResult::nothing_yet;
  }
  check(status, "read a frame");
  readStream(*streams[std::size_t(ready)], ready == 0);
  return take(frame) ? ReadResult::frame : ReadResult::nothing_yet;
}

void OpenNi2Device::readStream(openni::VideoStream& stream, bool is_depth) {
  openni::VideoFrameRef image;
  check(stream.readFrame(&image), "read a frame");
  const bool mirrored = stream.getMirroringEnabled();
  if (!is_depth) {
    pairs_->add(colorImage(image, mirrored));
  } else if (hasColor()) {
    pairs_->add(depthImage(image, mirrored));
  } else {
    newest_depth_ = depthImage(image, mirrored);
  }
}

bool OpenNi2Device::take(CameraFrame& frame) {
  frame.intrinsics = description_.intrinsics;
  if (hasColor()) return pairs_->take(frame);
  if (newest_depth_.pixels.empty()) return false;
  frame.depth = std::exchange(newest_depth_, {});
  frame.color = {};
  return true;
}

}  // namespace sks_detector
