// SPDX-License-Identifier: BSD-3-Clause
#include "ros/pose_output.hpp"

#include <algorithm>
#include <cctype>
#include <set>
#include <utility>

#include <geometry_msgs/PoseArray.h>
#include <geometry_msgs/PoseStamped.h>

#include "ros/master_access.hpp"

namespace sks_detector {

std::vector<std::string> topicNames(const std::vector<std::string>& objects) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const std::string& object : objects) {
    std::string base = object;
    for (char& c : base) {
      if (!std::isalnum(static_cast<unsigned char>(c)) || static_cast<unsigned char>(c) >= 0x80) c = '_';
    }
    std::string name = base;
    for (int number = 2; !taken.insert(name).second; ++number) name = base + "_" + std::to_string(number);
    names.push_back(name);
  }
  return names;
}

PoseOutput::PoseOutput(const ros::NodeHandle& private_handle, std::function<void()> listeners_changed)
    : handle_(private_handle), listeners_changed_(std::move(listeners_changed)) {
  const ros::SubscriberStatusCallback changed = [this](const ros::SingleSubscriberPublisher&) { listeners_changed_(); };
  all_ = handle_.advertise<geometry_msgs::PoseArray>("poses", 1, changed, changed);
}

void PoseOutput::setObjects(const std::vector<std::string>& objects) {
  const auto is_done = [&] {
    const std::lock_guard<std::mutex> lock(mutex_);
    return best_of_.size() == objects.size() &&
           std::all_of(objects.begin(), objects.end(), [&](const auto& object) { return best_of_.count(object) > 0; });
  };
  if (is_done() || !masterAnswers()) return;
  const ros::SubscriberStatusCallback changed = [this](const ros::SingleSubscriberPublisher&) { listeners_changed_(); };
  const std::vector<std::string> names = topicNames(objects);
  std::map<std::string, ros::Publisher> publishers;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    publishers[objects[i]] =
        handle_.advertise<geometry_msgs::PoseStamped>("objects/" + names[i] + "/pose", 1, changed, changed);
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    best_of_.swap(publishers);
  }
  publishers.clear();
  listeners_changed_();  // those of topics that are gone
}

bool PoseOutput::listened() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return all_.getNumSubscribers() > 0 || std::any_of(best_of_.begin(), best_of_.end(), [](const auto& publisher) {
           return publisher.second.getNumSubscribers() > 0;
         });
}

void PoseOutput::publish(const DetectionArray& detections) {
  geometry_msgs::PoseArray all;
  all.header = detections.header;
  std::set<std::string> done;
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const Detection& detection : detections.detections) {  // the best first
    all.poses.push_back(detection.pose.pose);
    const auto publisher = best_of_.find(detection.object);
    if (publisher == best_of_.end() || !done.insert(detection.object).second) continue;
    geometry_msgs::PoseStamped best;
    best.header = detections.header;
    best.pose = detection.pose.pose;
    publisher->second.publish(best);
  }
  all_.publish(all);
}

}  // namespace sks_detector
