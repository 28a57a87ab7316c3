// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include <ros/message_event.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <sensor_msgs/PointCloud2.h>

#include "ros/sequence_gaps.hpp"

namespace sks_detector {

/// The clouds of `~points`, subscribed to only while somebody wants them; of those that wait the newest wins. Safe to
/// use from several threads.
class CloudInput {
public:
  using Clock = std::chrono::steady_clock;

  struct Frame {
    sensor_msgs::PointCloud2ConstPtr cloud;
    Clock::time_point received;
    ros::Time received_at;  ///< the same by the clock of ROS, which may jump
  };

  struct Counts {
    std::uint64_t received = 0;
    std::uint64_t dropped =
        0;                   ///< overtaken by a newer one before they were taken, or not wanted any more; and lost ones
    std::uint64_t lost = 0;  ///< dropped on the way here, by the queue of the publisher or of roscpp
  };

  explicit CloudInput(const ros::NodeHandle& private_handle);
  ~CloudInput();
  CloudInput(const CloudInput&) = delete;
  CloudInput& operator=(const CloudInput&) = delete;

  /// Whether clouds for take() are wanted at the moment; if not, none waits any more. What cannot be subscribed to, as
  /// the master is away, is as soon as refresh() finds it back.
  void setWanted(bool wanted);
  /// Waits for a cloud; nothing after stop().
  std::optional<Frame> take();
  /// NextCloud of next_cloud.hpp.
  sensor_msgs::PointCloud2ConstPtr next(double timeout);
  /// To be called about once a second: subscribes or unsubscribes where the master was away when that was to be done.
  void refresh() { updateSubscription(); }
  /// Counts a cloud that was taken and is not used, as time jumped or nobody wants it any more.
  void countDropped();
  /// Lets all who wait go, and unsubscribes for good.
  void stop();

  std::string topic() const { return topic_; }  ///< resolved
  std::uint32_t publishers() const;
  /// describeInput() of its topic, at most two seconds old.
  std::string describePublishers() const;
  bool subscribed() const;
  /// Whether clouds are wanted and cannot be subscribed to, as the master is away.
  bool lacksMaster() const { return lacks_master_; }
  Counts counts() const;
  /// Since the last cloud, or since the subscription if that is later [s]; 0 while not subscribed.
  double silence() const;

private:
  using Event = ros::MessageEvent<const sensor_msgs::PointCloud2>;

  void receive(const Event& event);
  bool needed() const;
  void updateSubscription();

  ros::NodeHandle private_handle_;
  const std::string topic_;

  mutable std::mutex subscribing_;  // never taken by receive(): unsubscribing waits for that to return
  ros::Subscriber subscriber_;
  std::atomic<bool> lacks_master_{false};

  mutable std::mutex describing_;  // guards the next two
  mutable std::string description_;
  mutable Clock::time_point described_;

  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  bool wanted_ = false;
  bool stopped_ = false;
  int waiting_ = 0;  // in next()
  std::optional<Frame> frame_;
  sensor_msgs::PointCloud2ConstPtr last_;  // kept only while somebody waits in next()
  Counts counts_;
  SequenceGaps gaps_;
  Clock::time_point last_sign_of_life_;
};

}  // namespace sks_detector
