// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include <sensor_msgs/PointCloud2.h>

namespace sks_detector {

/// Subscribes to `~points` if need be and waits for the next cloud, whatever the node is doing meanwhile; called from
/// the services' thread. @throws sks::Error(bad_data) naming the resolved topic and its number of publishers after
/// `timeout` [s], or when the node shuts down
using NextCloud = std::function<sensor_msgs::PointCloud2ConstPtr(double timeout)>;

}  // namespace sks_detector
