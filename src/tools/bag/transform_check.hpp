// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include <ros/time.h>
#include <tf2_msgs/TFMessage.h>

#include "tools/bag/remarks.hpp"

namespace sks::tools {

/// Whether the transforms of a bag make one tree in which the frames of the clouds stand at the times of the clouds.
class TransformCheck {
public:
  void add(const tf2_msgs::TFMessage& message, bool is_static);

  /// Every frame, with its parent ("" at a root).
  std::map<std::string, std::string> tree() const;
  std::vector<std::string> roots() const;

  void remark(Remarks& remarks) const;
  /// What stands in the way of transforming clouds. @param frame of the clouds, as their headers name it
  void remarkOn(const std::string& topic, const std::string& frame, const std::vector<ros::Time>& stamps,
                Remarks& remarks) const;

private:
  struct Edge {
    bool is_static = false;
    std::size_t count = 0;
    ros::Time first, last;
  };

  std::string parentOf(const std::string& frame) const;
  bool inLoop(const std::string& frame) const;

  std::map<std::string, std::map<std::string, Edge>> edges_;  // child, parent
  std::set<std::string> slashed_;                             // frames that were named with a leading slash
};

}  // namespace sks::tools
