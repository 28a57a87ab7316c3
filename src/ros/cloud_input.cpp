// SPDX-License-Identifier: BSD-3-Clause
#include "ros/cloud_input.hpp"

#include <algorithm>
#include <utility>

#include <ros/this_node.h>

#include <sks_detector/error.hpp>

#include "core/settings/value_text.hpp"
#include "ros/master_access.hpp"
#include "ros/topic_advice.hpp"

namespace sks_detector {
namespace {

// The newest cloud wins in receive(), which only takes pointers: this queue delays nothing. With one place in it roscpp
// drops clouds, 3 of 120 at 30 Hz of 640x480 on a busy machine, and what comes from nodelets of the same process has no
// numbers by which they could be counted.
constexpr std::uint32_t subscription_queue = 4;

constexpr std::chrono::milliseconds retry_period(500);  // while the master is away

constexpr std::chrono::seconds description_period(2);  // the master is not asked more often

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
    if (!wanted && frame_) {
      ++counts_.dropped;
      frame_.reset();
    }
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
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(timeout));
  const auto done = [this] { return stopped_ || last_; };
  for (bool waits = true; waits;) {
    updateSubscription();
    std::unique_lock<std::mutex> lock(mutex_);
    waits = !changed_.wait_until(lock, std::min(end, Clock::now() + retry_period), done) && Clock::now() < end;
  }
  sensor_msgs::PointCloud2ConstPtr cloud;
  std::string failure;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    cloud = last_;
    if (--waiting_ == 0) last_.reset();
    if (stopped_) failure = "the node shuts down";
  }
  if (!cloud && failure.empty()) {
    failure = "no cloud came on " + topic_ + " within " + sks::toText(timeout) + " s (" +
              (lacks_master_ ? masterIsAway() : describePublishers()) + ")";
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

void CloudInput::countDropped() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++counts_.dropped;
}

void CloudInput::receive(const Event& event) {
  const sensor_msgs::PointCloud2ConstPtr cloud = event.getConstMessage();
  const std::string& publisher = event.getPublisherName();
  const bool numbered = publisher != ros::this_node::getName();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (stopped_) return;
    last_sign_of_life_ = Clock::now();
    if (waiting_ > 0) last_ = cloud;
    const std::uint32_t lost = numbered ? gaps_.lostBefore(publisher, cloud->header.seq, last_sign_of_life_) : 0;
    if (wanted_) {
      counts_.lost += lost;
      counts_.dropped += lost;
      ++counts_.received;
      if (frame_) ++counts_.dropped;
      frame_ = Frame{cloud, last_sign_of_life_, ros::Time::now()};
    }
  }
  changed_.notify_all();
}

bool CloudInput::needed() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return !stopped_ && (wanted_ || waiting_ > 0);
}

void CloudInput::updateSubscription() {
  const bool away = needed() != subscribed() && !masterAnswers();  // without a lock: it may take a while
  const std::lock_guard<std::mutex> subscribing(subscribing_);
  const bool needed = this->needed();
  lacks_master_ = away && needed && !subscriber_;
  if (needed == bool(subscriber_)) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (away && !stopped_) return;  // what is subscribed to stays so: it could not be had again
    last_sign_of_life_ = Clock::now();
    gaps_.clear();
  }
  if (needed) {
    subscriber_ = private_handle_.subscribe("points", subscription_queue, &CloudInput::receive, this,
                                            ros::TransportHints().tcpNoDelay());
  } else {
    subscriber_.shutdown();
    subscriber_ = ros::Subscriber();
  }
}

std::string CloudInput::describePublishers() const {
  {
    const std::lock_guard<std::mutex> lock(describing_);
    if (!description_.empty() && Clock::now() - described_ < description_period) return description_;
  }
  const std::string description = describeInput(topic_, publishers(), private_handle_.getNamespace());
  const std::lock_guard<std::mutex> lock(describing_);
  described_ = Clock::now();
  return description_ = description;
}

}  // namespace sks_detector
