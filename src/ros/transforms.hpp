// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>

#include <ros/time.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>
#include <Eigen/Geometry>

namespace sks_detector {

/// Frame names as tf2 has them: without the leading slash of tf.
std::string withoutSlash(const std::string& frame);

/// Transforms of tf2. Safe to use from several threads.
class Transforms {
public:
  /// Starts to listen to /tf and /tf_static, if it was not done yet: nodes that need no transforms do not pay for them.
  void listen();
  /// Forgets what is not static, after time jumped back.
  void clear();
  /// Lets lookup() fail at once.
  void stop() { stopped_ = true; }

  /// T_target_source at `stamp`; waits up to `timeout` [s, wall-clock] for it.
  /// @throws sks::Error(bad_data) naming the frames and what tf2 says
  Eigen::Isometry3d lookup(const std::string& target, const std::string& source, const ros::Time& stamp,
                           double timeout);

private:
  tf2_ros::Buffer buffer_;
  std::mutex mutex_;
  std::unique_ptr<tf2_ros::TransformListener> listener_;
  std::atomic<bool> stopped_{false};
};

}  // namespace sks_detector
