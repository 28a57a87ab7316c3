// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Header.h>

#include <sks_detector/cloud.hpp>

namespace sks_detector {

/// Positions and, where fields of io/point_colors.hpp are there, colours; organised or not, dense or not, rows padded
/// or not: `row_step` counts only where the points do not fill the data.
/// @throws sks::Error(bad_data) saying what is wrong with the message's fields or lengths, also where it is big-endian
sks::Cloud toCloud(const sensor_msgs::PointCloud2& message);

/// What the node does with each cloud that comes: toCloud(), but one of more points is refused before.
sks::Cloud receivedCloud(const sensor_msgs::PointCloud2& message, int max_points);

/// Fields x, y, z and, where the cloud has colour, rgb; 12 or 16 bytes a point, rows without gaps.
sensor_msgs::PointCloud2 toMessage(const sks::Cloud& cloud, const std_msgs::Header& header);

}  // namespace sks_detector
