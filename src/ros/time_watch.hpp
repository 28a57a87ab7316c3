// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mutex>

#include <ros/time.h>

namespace sks_detector {

/// Notices when the clock of ROS jumps back, as it does when a bag starts again. Safe to use from several threads.
class TimeWatch {
public:
  /// How far the clock went back since the last call [s]; 0 if it did not.
  double jumpedBack() {
    const std::lock_guard<std::mutex> lock(mutex_);
    const ros::Time now = ros::Time::now();
    const double back = now < last_ ? (last_ - now).toSec() : 0;
    last_ = now;
    return back;
  }

private:
  std::mutex mutex_;
  ros::Time last_;
};

}  // namespace sks_detector
