// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <mutex>
#include <string>

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <ros/subscriber.h>
#include <ros/time.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>
#include <Eigen/Geometry>

namespace sks_detector {

/// Transforms of tf2. Safe to use from several threads. Unlike tf2_ros::TransformListener it survives what others send:
/// a stamp at the end of time, for example, makes tf2 throw.
class Transforms {
public:
  Transforms();
  ~Transforms();
  Transforms(const Transforms&) = delete;
  Transforms& operator=(const Transforms&) = delete;

  /// Starts to listen to /tf and /tf_static, if it was not done yet: nodes that need no transforms do not pay for them.
  /// False while the master is away, so that it is to be tried again.
  bool listen();
  /// Forgets what is not static, after time jumped back.
  void clear() { buffer_.clear(); }
  /// Lets lookup() fail at once.
  void stop() { stopped_ = true; }

  /// T_target_source at `stamp`; waits up to `timeout` [s, wall-clock] for it.
  /// @throws sks::Error(bad_data) naming the frames and what tf2 says
  Eigen::Isometry3d lookup(const std::string& target, const std::string& source, const ros::Time& stamp,
                           double timeout);

private:
  using Message = tf2_msgs::TFMessage;

  void receive(const ros::MessageEvent<const Message>& event, bool is_static);

  tf2::BufferCore buffer_;
  std::atomic<bool> stopped_{false};
  ros::CallbackQueue queue_;
  ros::NodeHandle handle_;
  std::mutex mutex_;  // guards the subscribers while they are made
  ros::Subscriber changing_, static_;
  ros::AsyncSpinner spinner_{1, &queue_};
};

}  // namespace sks_detector
