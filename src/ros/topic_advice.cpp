// SPDX-License-Identifier: BSD-3-Clause
#include "ros/topic_advice.hpp"

#include <algorithm>
#include <vector>

#include <ros/master.h>
#include <ros/message_traits.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include "core/settings/shown_text.hpp"
#include "ros/master_access.hpp"

namespace sks_detector {
namespace {

std::string cloudType() {
  return ros::message_traits::datatype<sensor_msgs::PointCloud2>();
}

std::string wrongType(const std::string& type) {
  const std::string remedy = type == ros::message_traits::datatype<sensor_msgs::Image>()
                                 ? "; depth_images.launch makes clouds of depth and colour images"
                                 : "";
  return "it is a topic of " + type + ", not of " + cloudType() + remedy;
}

std::vector<std::string> cloudTopics(const ros::master::V_TopicInfo& topics, const std::string& own_namespace) {
  std::vector<std::string> names;
  for (const ros::master::TopicInfo& topic : topics) {
    const bool own = topic.name.rfind(own_namespace + "/", 0) == 0;
    if (topic.datatype == cloudType() && !own) names.push_back(topic.name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

std::string describeInput(const std::string& topic, std::uint32_t publishers, const std::string& own_namespace) {
  const std::string count = std::to_string(publishers) + (publishers == 1 ? " publisher" : " publishers");
  ros::master::V_TopicInfo topics;
  if (!masterAnswers() || !ros::master::getTopics(topics)) return "it has " + count;
  const auto same = std::find_if(topics.begin(), topics.end(), [&](const auto& other) { return other.name == topic; });
  if (same != topics.end() && same->datatype != cloudType() && same->datatype != "*") return wrongType(same->datatype);
  if (publishers > 0 || same != topics.end()) return "it has " + count;
  const std::vector<std::string> clouds = cloudTopics(topics, own_namespace);
  return "it has no publisher; " +
         (clouds.empty() ? "no topic of clouds has one" : "topics of clouds are " + sks::shownList(clouds));
}

}  // namespace sks_detector
