// SPDX-License-Identifier: BSD-3-Clause
#include "ros/camera/camera_node.hpp"

#include <algorithm>
#include <utility>

#include <ros/console.h>

#include "ros/camera/camera_messages.hpp"
#include "ros/camera/camera_parameters.hpp"
#include "ros/camera/openni2_device.hpp"

namespace sks_detector {
namespace {

using diagnostic_msgs::DiagnosticStatus;

const char* textOf(CameraState state) {
  switch (state) {
    case CameraState::connecting:
      return "not connected";
    case CameraState::idle:
      return "idle: nobody listens";
    case CameraState::streaming:
      return "running";
    case CameraState::ended:
      break;
  }
  return "the recording has ended";
}

void log(bool problem, const std::string& message) {
  if (problem) {
    ROS_WARN_STREAM(message);
  } else {
    ROS_INFO_STREAM(message);
  }
}

}  // namespace

CameraNode::CameraNode(const ros::NodeHandle& private_handle, const std::string& name)
    : private_handle_(private_handle) {
  const CameraParameters parameters = readCameraParameters(private_handle_);
  for (const std::string& problem : parameters.problems) ROS_WARN_STREAM("Camera: " << problem);
  settings_ = parameters.settings;
  if (!settings_.frame_id.empty() && settings_.frame_id[0] == '/') settings_.frame_id.erase(0, 1);  // as tf2 wants it

  updater_ = std::make_unique<diagnostic_updater::Updater>(ros::NodeHandle(), private_handle_, name);
  updater_->setHardwareID("none");
  updater_->add("camera", this, &CameraNode::diagnose);
  diagnosed_ = ros::SteadyTime::now();
  camera_ = std::make_unique<Camera>(
      settings_, [settings = settings_] { return std::make_unique<OpenNi2Device>(settings); },
      [this](const CameraFrame& frame) { publish(frame); }, log);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    points_ = advertise<sensor_msgs::PointCloud2>("points");
    info_ = advertise<sensor_msgs::CameraInfo>("camera_info");
    depth_ = advertise<sensor_msgs::Image>("depth_image");
    color_ = advertise<sensor_msgs::Image>("color_image");
  }
  updateWanted();
  timer_ = private_handle_.createSteadyTimer(ros::WallDuration(1.0),
                                             [this](const ros::SteadyTimerEvent&) { updater_->force_update(); });
}

CameraNode::~CameraNode() {
  timer_.stop();
  std::unique_ptr<Camera> camera;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    camera = std::move(camera_);
  }
  camera.reset();  // not under the lock, which its thread takes
}

template <typename Message>
ros::Publisher CameraNode::advertise(const std::string& topic) {
  const auto changed = [this](const ros::SingleSubscriberPublisher&) { updateWanted(); };
  return private_handle_.advertise<Message>(topic, 1, changed, changed);
}

void CameraNode::updateWanted() {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto listened = [](const ros::Publisher& publisher) { return publisher.getNumSubscribers() > 0; };
  if (!camera_) return;
  camera_->setWanted(settings_.always_on || listened(points_) || listened(info_) || listened(depth_) ||
                     listened(color_));
}

ros::Time CameraNode::nextStamp() {
  ros::Time stamp = ros::Time::now();
  const bool clock_was_set_back = stamp + ros::Duration(1.0) < last_stamp_;
  if (!clock_was_set_back) stamp = std::max(stamp, last_stamp_ + ros::Duration(0, 1));
  return last_stamp_ = stamp;
}

void CameraNode::publish(const CameraFrame& frame) {
  std_msgs::Header header;
  header.stamp = nextStamp();
  header.frame_id = settings_.frame_id;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (info_.getNumSubscribers() > 0) info_.publish(cameraInfoMessage(frame, header));
  if (depth_.getNumSubscribers() > 0) depth_.publish(depthMessage(frame.depth, header));
  if (color_.getNumSubscribers() > 0 && !frame.color.pixels.empty()) color_.publish(colorMessage(frame.color, header));
  if (points_.getNumSubscribers() > 0) points_.publish(cloudMessage(frame, header));
}

void CameraNode::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const CameraStatus camera = camera_->status();
  const ros::SteadyTime now = ros::SteadyTime::now();
  const double rate = double(camera.frames - frames_before_) / std::max((now - diagnosed_).toSec(), 1e-3);
  frames_before_ = camera.frames;
  diagnosed_ = now;

  status.summary(DiagnosticStatus::OK, textOf(camera.state));
  const bool streamed = std::exchange(streaming_, camera.state == CameraState::streaming);
  if (streamed && streaming_ && rate < 0.5 * camera.device.depth_mode.rate) {
    status.summary(DiagnosticStatus::WARN, "frames come less than half as often as they should");
  }
  if (camera.state == CameraState::connecting) {
    status.summary(DiagnosticStatus::ERROR, camera.error.empty() ? textOf(camera.state) : camera.error);
  }
  status.add("device", camera.device.name);
  status.add("uri", camera.device.uri);
  status.add("serial number", camera.device.serial);
  status.add("depth", toText(camera.device.depth_mode));
  status.add("colour", camera.device.color_mode.width > 0 ? toText(camera.device.color_mode) : "none");
  status.add("registered", camera.device.registered);
  status.addf("rate [Hz]", "%.1f", rate);
  status.add("frames", camera.frames);
  status.add("reconnects", camera.reconnects);
}

}  // namespace sks_detector
