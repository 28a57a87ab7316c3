// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <sks_detector/error.hpp>

namespace sks::tools {

/// What a bag holds under one name.
struct BagTopic {
  std::string name;
  std::string type;  ///< e.g. "sensor_msgs/PointCloud2"
  std::size_t messages = 0;
};

/// A bag that is read; what rosbag complains about is said in the core's words.
class BagFile {
public:
  /// @throws Error(bad_file) with the remedy where the file is missing, foreign, damaged, empty or has no index
  explicit BagFile(const std::string& path);

  const std::string& path() const { return path_; }
  /// By name; a topic that had several types comes once for each.
  const std::vector<BagTopic>& topics() const { return topics_; }
  std::vector<std::string> topicsOf(const std::string& type) const;
  std::size_t messageCount() const;
  /// First and last time of recording.
  std::pair<ros::Time, ros::Time> timeRange() const { return time_range_; }

  /// A topic of a type, by its name with or without the leading slash.
  /// @throws Error(bad_data) naming the topics of that type that there are
  std::string findTopic(const std::string& name, const std::string& type) const;

  /// Calls `f(message, time at which it was recorded)` in the order of recording.
  /// @throws Error(bad_file) for a damaged bag or another version of the message, and whatever `f` throws
  template <typename Message, typename Function>
  void forEach(const std::string& topic, Function f) const {
    forEach<Message>(topic, ros::TIME_MIN, ros::TIME_MAX, f);
  }
  template <typename Message, typename Function>
  void forEach(const std::string& topic, const ros::Time& from, const ros::Time& to, Function f) const {
    guard([&] {
      rosbag::View view(bag_, isTopic(topic, ros::message_traits::datatype<Message>()), from, to);
      for (const rosbag::MessageInstance& instance : view) {
        const auto message = instance.instantiate<Message>();
        if (!message) failType(topic, instance.getDataType());
        f(*message, instance.getTime());
      }
    });
  }

private:
  using TopicQuery = boost::function<bool(const rosbag::ConnectionInfo*)>;

  static TopicQuery isTopic(const std::string& topic, const std::string& type);
  [[noreturn]] void failType(const std::string& topic, const std::string& type) const;
  [[noreturn]] void failDamaged(const std::string& reason) const;

  template <typename Function>
  void guard(Function f) const {
    try {
      f();
    } catch (const Error&) {
      throw;
    } catch (const std::exception& error) {
      failDamaged(error.what());
    }
  }

  std::string path_;
  rosbag::Bag bag_;
  std::vector<BagTopic> topics_;
  std::pair<ros::Time, ros::Time> time_range_;
};

}  // namespace sks::tools
