// SPDX-License-Identifier: BSD-3-Clause
#include "ros/cloud_input.hpp"

#include <utility>

#include <sks_detector/error.hpp>

#include "core/settings/value_text.hpp"

namespace sks_detector {
namespace {

// The newest cloud wins in receive(), which only takes pointers: this queue delays nothing. With one place in it roscpp
// drops clouds that nobody counts, 3 of 120 at 30 Hz of 640x480 on a busy machine, and gaps in header.seq do not tell:
// nodelets in one manager, and bags that are played, do not number anew.
constexpr std::uint32_t subscription_queue = 4;

}  // namespace

CloudInput::CloudInput(const ros::NodeHandle& private_handle)
    : private_handle_(private_handle), topic_(private_handle_.resolveName("points")) {}

CloudInput::~CloudInput() {
  stop();
}

void CloudInput::setWanted(bool wanted) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    wanted_ = wanted;
    if (!wanted) frame_.reset();
  }
  updateSubscription();
}

std::optional<CloudInput::Frame> CloudInput::take() {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return stopped_ || frame_; });
  if (stopped_) return std::nullopt;
  return std::exchange(frame_, std::nullopt);
}

sensor_msgs::PointCloud2ConstPtr CloudInput::next(double timeout) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (waiting_++ == 0) last_.reset();
  }
  updateSubscription();
  sensor_msgs::PointCloud2ConstPtr cloud;
  std::string failure;
  {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait_for(lock, std::chrono::duration<double>(timeout), [this] { return stopped_ || last_; });
    cloud = last_;
    if (--waiting_ == 0) last_.reset();
    if (stopped_) failure = "the node shuts down";
  }
  if (!cloud && failure.empty()) {
    failure = "no cloud came on " + topic_ + " within " + sks::toText(timeout) + " s (" + describePublishers() + ")";
  }
  updateSubscription();
  if (!failure.empty()) throw sks::Error(sks::ErrorCode::bad_data, failure);
  return cloud;
}

void CloudInput::stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopped_ = true;
    frame_.reset();
  }
  changed_.notify_all();
  updateSubscription();
}

std::uint32_t CloudInput::publishers() const {
  const std::lock_guard<std::mutex> lock(subscribing_);
  return subscriber_ ? subscriber_.getNumPublishers() : 0;
}

bool CloudInput::subscribed() const {
  const std::lock_guard<std::mutex> lock(subscribing_);
  return bool(subscriber_);
}

CloudInput::Counts CloudInput::counts() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return counts_;
}

double CloudInput::silence() const {
  if (!subscribed()) return 0;
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::chrono::duration<double>(Clock::now() - last_sign_of_life_).count();
}

void CloudInput::receive(const sensor_msgs::PointCloud2ConstPtr& cloud) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (stopped_) return;
    last_sign_of_life_ = Clock::now();
    if (waiting_ > 0) last_ = cloud;
    if (wanted_) {
      ++counts_.received;
      if (frame_) ++counts_.dropped;
      frame_ = Frame{cloud, last_sign_of_life_, ros::Time::now()};
    }
  }
  changed_.notify_all();
}

void CloudInput::updateSubscription() {
  const std::lock_guard<std::mutex> subscribing(subscribing_);
  bool needed = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    needed = !stopped_ && (wanted_ || waiting_ > 0);
    if (needed && !subscriber_) last_sign_of_life_ = Clock::now();
  }
  if (needed && !subscriber_) {
    subscriber_ = private_handle_.subscribe<sensor_msgs::PointCloud2>(
        "points", subscription_queue, &CloudInput::receive, this, ros::TransportHints().tcpNoDelay());
  } else if (!needed && subscriber_) {
    subscriber_.shutdown();
    subscriber_ = ros::Subscriber();
  }
}

std::string CloudInput::describePublishers() const {
  const std::uint32_t count = publishers();
  return count == 1 ? "1 publisher" : std::to_string(count) + " publishers";
}

}  // namespace sks_detector
