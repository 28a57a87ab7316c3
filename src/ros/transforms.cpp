// SPDX-License-Identifier: BSD-3-Clause
#include "ros/transforms.hpp"

#include <chrono>
#include <thread>

#include <tf2_eigen/tf2_eigen.h>

#include <sks_detector/error.hpp>

#include "core/value_text.hpp"

namespace sks_detector {

std::string withoutSlash(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

void Transforms::listen() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!listener_) listener_ = std::make_unique<tf2_ros::TransformListener>(buffer_);
}

void Transforms::clear() {
  buffer_.clear();
}

Eigen::Isometry3d Transforms::lookup(const std::string& target, const std::string& source, const ros::Time& stamp,
                                     double timeout) {
  if (target == source) return Eigen::Isometry3d::Identity();
  listen();
  // tf2's own waiting goes by the clock of ROS, which stands still while a bag is paused
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(timeout);
  std::string reason;
  while (!stopped_) {
    if (buffer_.tf2::BufferCore::canTransform(target, source, stamp, &reason)) {
      return tf2::transformToEigen(buffer_.tf2::BufferCore::lookupTransform(target, source, stamp));
    }
    if (Clock::now() >= end) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  throw sks::Error(sks::ErrorCode::bad_data, "no transform from '" + source + "' to '" + target + "' within " +
                                                 sks::toText(timeout) + " s: " + reason);
}

}  // namespace sks_detector
