// SPDX-License-Identifier: BSD-3-Clause
#include "ros/support_message.hpp"

#include "ros/detection_message.hpp"

namespace sks_detector {

Support toMessage(const std::optional<sks::Support>& support, const Eigen::Isometry3d& T_target_cloud,
                  const std_msgs::Header& header) {
  Support message;
  message.header = header;
  message.found = support.has_value();
  message.pose.orientation.w = 1;
  if (!support) return message;
  message.pose = toMessage(T_target_cloud * support->T_scene_plane);
  message.size_x = support->size.x();
  message.size_y = support->size.y();
  for (const Eigen::Vector2d& corner : support->outline) {
    geometry_msgs::Point32 point;
    point.x = float(corner.x());
    point.y = float(corner.y());
    message.outline.push_back(point);
  }
  message.standing = std::uint32_t(support->standing);
  return message;
}

}  // namespace sks_detector
