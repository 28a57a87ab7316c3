// SPDX-License-Identifier: BSD-3-Clause
#include "tools/bag/bag_file.hpp"

#include <algorithm>
#include <filesystem>
#include <map>

#include <sks_detector/error.hpp>

#include "io/regular_file.hpp"

namespace sks::tools {
namespace {

/// tf/tfMessage is what tf2_msgs/TFMessage was called before.
std::string currentName(const std::string& type) {
  return type == "tf/tfMessage" ? "tf2_msgs/TFMessage" : type;
}

[[noreturn]] void fail(const std::string& message) {
  throw Error(ErrorCode::bad_file, message);
}

void checkIsFile(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) fail("cannot read '" + path + "': it is a folder, not a bag");
  std::string magic(7, '\0');
  std::size_t size = 0;
  try {
    size = RegularFile(path).read(magic.data(), magic.size(), 0);
  } catch (const Error& error) {
    fail("cannot read '" + path + "': " + error.what());
  }
  if (size == 0) fail("'" + path + "' is an empty file; was the recording ended at once?");
  if (magic != "#ROSBAG" && magic != "#ROSREC") fail("'" + path + "' is no ROS bag");
}

}  // namespace

BagFile::BagFile(const std::string& path) : path_(path) {
  checkIsFile(path);
  try {
    bag_.open(path, rosbag::bagmode::Read);
  } catch (const rosbag::BagUnindexedException&) {
    fail("'" + path + "' has no index, as when a recording was not ended: run `rosbag reindex " + path + "`");
  } catch (const std::exception& error) {
    failDamaged(error.what());
  }
  guard([&] {
    rosbag::View view(bag_);
    if (view.size() == 0) fail("'" + path + "' holds no messages; was anything published while it was recorded?");
    time_range_ = {view.getBeginTime(), view.getEndTime()};
    std::map<std::pair<std::string, std::string>, std::size_t> counts;
    for (const rosbag::ConnectionInfo* connection : view.getConnections()) {
      const auto key = std::make_pair(connection->topic, currentName(connection->datatype));
      if (counts.count(key)) continue;
      counts[key] = rosbag::View(bag_, isTopic(key.first, key.second)).size();
    }
    for (const auto& [key, count] : counts) topics_.push_back({key.first, key.second, count});
  });
}

BagFile::TopicQuery BagFile::isTopic(const std::string& topic, const std::string& type) {
  return [topic, type](const rosbag::ConnectionInfo* connection) {
    return connection->topic == topic && currentName(connection->datatype) == type;
  };
}

void BagFile::failType(const std::string& topic, const std::string& type) const {
  fail("'" + path_ + "': " + topic + " was recorded with another version of " + type +
       ", which this program does not know; `rosbag check` tells the difference");
}

void BagFile::failDamaged(const std::string& reason) const {
  fail("'" + path_ + "' is damaged (" + reason + "): `rosbag reindex " + path_ + "` saves what can be read");
}

std::vector<std::string> BagFile::topicsOf(const std::string& type) const {
  std::vector<std::string> names;
  for (const BagTopic& topic : topics_) {
    if (topic.type == type) names.push_back(topic.name);
  }
  return names;
}

std::size_t BagFile::messageCount() const {
  std::size_t count = 0;
  for (const BagTopic& topic : topics_) count += topic.messages;
  return count;
}

std::string BagFile::findTopic(const std::string& name, const std::string& type) const {
  const std::vector<std::string> names = topicsOf(type);
  for (const std::string& candidate : names) {
    if (candidate == name || candidate == "/" + name) return candidate;
  }
  std::string known;
  for (const std::string& candidate : names) known += (known.empty() ? "" : ", ") + candidate;
  throw Error(ErrorCode::bad_data, "'" + path_ + "' has no topic '" + name + "' of type " + type + "; it has " +
                                       (known.empty() ? "none of that type" : known));
}

}  // namespace sks::tools
