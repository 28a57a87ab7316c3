// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <string>

#include <sensor_msgs/PointCloud2.h>

#include "tools/bag/remarks.hpp"
#include "tools/bag/stamp_check.hpp"

namespace sks::tools {

/// What the clouds of one topic are like, and what the node would complain about: they go through the same gates.
class CloudCheck {
public:
  explicit CloudCheck(std::string topic) : topic_(std::move(topic)) {}

  void add(const sensor_msgs::PointCloud2& message, const ros::Time& recorded);

  const std::string& topic() const { return topic_; }
  std::size_t count() const { return stamps_.stamps().size(); }
  std::size_t usable() const { return usable_; }
  const StampCheck& stamps() const { return stamps_; }
  const std::set<std::string>& frames() const { return frames_; }  ///< as the headers name them
  std::uint32_t width() const { return width_; }                   ///< of the last cloud
  std::uint32_t height() const { return height_; }
  std::uint32_t pointStep() const { return point_step_; }  ///< bytes
  const std::string& fields() const { return fields_; }    ///< names, separated by spaces
  bool organized() const { return height_ > 1; }
  bool colored() const { return count() > 0 && uncolored_ == 0; }
  double invalidShare() const;  ///< of NaN and infinite points, in [0, 1]

  void remark(Remarks& remarks) const;

private:
  std::string topic_;
  StampCheck stamps_;
  std::set<std::string> frames_;
  std::map<std::string, std::size_t> refusals_;  // messages, and of how many clouds
  std::size_t usable_ = 0, uncolored_ = 0, wrongly_dense_ = 0, resized_ = 0;
  std::size_t points_ = 0, invalid_ = 0;
  std::uint32_t width_ = 0, height_ = 0, point_step_ = 0;
  std::string fields_;
};

}  // namespace sks::tools
