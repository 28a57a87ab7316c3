// SPDX-License-Identifier: BSD-3-Clause
#include "tools/bag/recorded_detections.hpp"

#include <algorithm>

#include <sks_detector/DetectionArray.h>

#include "ros/detection_message.hpp"
#include "ros/frame_name.hpp"
#include "tools/bag/stamps.hpp"

namespace sks::tools {
namespace {

using sks_detector::withoutSlash;

constexpr char array_type[] = "sks_detector/DetectionArray";
constexpr char cloud_type[] = "sensor_msgs/PointCloud2";

bool isGroundTruth(const std::string& topic) {
  const std::size_t slash = topic.rfind('/');
  return topic.compare(slash == std::string::npos ? 0 : slash + 1, 12, "ground_truth") == 0;
}

/// The only one of some topics. @param option that chooses one of several
std::string onlyOne(const BagFile& bag, const std::vector<std::string>& topics, const std::string& option) {
  if (topics.empty()) return "";
  if (topics.size() == 1) return topics[0];
  std::string names;
  for (const std::string& topic : topics) names += (names.empty() ? "" : ", ") + topic;
  throw Error(ErrorCode::bad_data,
              "'" + bag.path() + "' has several topics that could be meant: " + names + "; choose one with " + option);
}

}  // namespace

std::string findGroundTruthTopic(const BagFile& bag, const std::string& given) {
  if (!given.empty()) return bag.findTopic(given, array_type);
  std::vector<std::string> topics = bag.topicsOf(array_type);
  topics.erase(std::remove_if(topics.begin(), topics.end(), [](const auto& topic) { return !isGroundTruth(topic); }),
               topics.end());
  return onlyOne(bag, topics, "--ground-truth");
}

std::string findDetectionsTopic(const BagFile& bag, const std::string& given, const std::string& ground_truth) {
  if (!given.empty()) return bag.findTopic(given, array_type);
  std::vector<std::string> topics;
  for (const std::string& topic : bag.topicsOf(array_type)) {
    if (topic != ground_truth && !isGroundTruth(topic)) topics.push_back(topic);
  }
  return onlyOne(bag, topics, "--detections");
}

RecordedDetections readDetections(const BagFile& bag, const std::string& topic) {
  RecordedDetections recorded;
  recorded.topic = topic;
  bag.forEach<sks_detector::DetectionArray>(topic, [&](const auto& message, const ros::Time&) {
    const auto [entry, fresh] = recorded.arrays.try_emplace(message.header.stamp);
    if (!fresh) {
      ++recorded.repeated;
      return;
    }
    RecordedArray& array = entry->second;
    array.frame = withoutSlash(message.header.frame_id);
    array.codebook = message.codebook;
    array.processing_time = message.processing_time;
    try {
      for (const auto& detection : message.detections) array.detections.push_back(sks_detector::toDetection(detection));
    } catch (const Error& error) {
      throw Error(ErrorCode::bad_data,
                  "'" + bag.path() + "', " + topic + " at " + stampText(message.header.stamp) + ": " + error.what());
    }
  });
  return recorded;
}

std::string findCloudTopic(const BagFile& bag, const std::string& name) {
  if (!name.empty()) return bag.findTopic(name, cloud_type);
  std::string topic = onlyOne(bag, bag.topicsOf(cloud_type), "--topic");
  if (topic.empty()) throw Error(ErrorCode::bad_data, "'" + bag.path() + "' has no topic of type " + cloud_type);
  return topic;
}

}  // namespace sks::tools
