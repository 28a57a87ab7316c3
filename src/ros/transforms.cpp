// SPDX-License-Identifier: BSD-3-Clause
#include "ros/transforms.hpp"

#include <chrono>
#include <thread>

#include <ros/console.h>
#include <tf2_eigen/tf2_eigen.h>

#include <sks_detector/error.hpp>

#include "core/settings/value_text.hpp"
#include "ros/master_access.hpp"

namespace sks_detector {
namespace {

constexpr std::uint32_t queue_size = 100;                // as tf2_ros has it
constexpr std::chrono::milliseconds listen_period(500);  // while the master is away

}  // namespace

Transforms::Transforms() {
  handle_.setCallbackQueue(&queue_);
}

Transforms::~Transforms() {
  spinner_.stop();
}

bool Transforms::listen() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (changing_ && static_) return true;
  if (!masterAnswers()) return false;
  using Event = ros::MessageEvent<const Message>;
  const auto subscribe = [this](const char* topic, bool is_static) {
    const boost::function<void(const Event&)> receive = [this, is_static](const Event& event) {
      this->receive(event, is_static);
    };
    return handle_.subscribe<Message>(topic, queue_size, receive);
  };
  if (!changing_) changing_ = subscribe("/tf", false);
  if (!static_) static_ = subscribe("/tf_static", true);
  spinner_.start();
  return changing_ && static_;
}

void Transforms::receive(const ros::MessageEvent<const Message>& event, bool is_static) {
  for (const geometry_msgs::TransformStamped& transform : event.getMessage()->transforms) {
    try {
      buffer_.setTransform(transform, event.getPublisherName(), is_static);
    } catch (const std::exception& error) {
      ROS_ERROR_STREAM_THROTTLE(30, "transform from '" << transform.child_frame_id << "' to '"
                                                       << transform.header.frame_id << "' of "
                                                       << event.getPublisherName() << " is ignored: " << error.what());
    }
  }
}

Eigen::Isometry3d Transforms::lookup(const std::string& target, const std::string& source, const ros::Time& stamp,
                                     double timeout) {
  if (target == source) return Eigen::Isometry3d::Identity();
  bool listens = listen();
  // tf2's own waiting goes by the clock of ROS, which stands still while a bag is paused
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(timeout);
  auto retried = Clock::now();
  std::string reason;
  while (!stopped_) {
    reason.clear();  // tf2 appends to it
    if (buffer_.canTransform(target, source, stamp, &reason)) {
      return tf2::transformToEigen(buffer_.lookupTransform(target, source, stamp));
    }
    if (Clock::now() >= end) break;
    if (!listens && Clock::now() >= retried + listen_period) {
      listens = listen();
      retried = Clock::now();
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  throw sks::Error(sks::ErrorCode::bad_data, "no transform from '" + source + "' to '" + target + "' within " +
                                                 sks::toText(timeout) + " s: " + (listens ? reason : masterIsAway()));
}

}  // namespace sks_detector
