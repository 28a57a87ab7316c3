// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include <ros/node_handle.h>
#include <sensor_msgs/PointCloud2.h>
#include <sks_detector/DetectionArray.h>
#include <std_msgs/Header.h>
#include <Eigen/Geometry>

#include <sks_detector/cloud.hpp>

#include "ros/detection_query.hpp"
#include "ros/detector_slot.hpp"
#include "ros/next_cloud.hpp"
#include "ros/node_settings.hpp"
#include "ros/status_board.hpp"

namespace sks_detector {

/// What the services ask the node to do; called from their threads, several at a time.
struct NodeAccess {
  NextCloud next_cloud;
  /// Detects in one cloud with the detector in the slot, as for `~points`: header, ~target_frame.
  /// @throws what FrameDetector::detect() throws
  std::function<DetectionArray(const sensor_msgs::PointCloud2ConstPtr& cloud, const DetectionQuery& query)> detect;
  /// Starts or stops the processing of `~points`.
  std::function<void(bool enabled)> enable;
  /// The cloud as the detector takes it: in its own frame, with the position of the camera (~sensor_frame).
  /// @throws sks::Error for an unusable cloud, or where a transform is missing
  std::function<sks::Cloud(const sensor_msgs::PointCloud2& cloud)> read;
  /// Pose of a cloud's frame in ~fixed_frame; none without ~fixed_frame.
  /// @throws sks::Error where the transform is missing
  std::function<std::optional<Eigen::Isometry3d>(const std_msgs::Header& cloud)> fixed_pose;
};

/// All services of the node (docs/services.md), on a callback queue and threads of their own: a long training blocks no
/// frame. Nothing that is thrown leaves a service: it is logged, kept in the status and replied.
class Services {
public:
  /// @param slot, board must outlive the services
  Services(const ros::NodeHandle& private_handle, DetectorSlot& slot, StatusBoard& board, const NodeSettings& settings,
           NodeAccess node);
  /// Cancels a training, waits for services that are under way, and takes the services back. Requests that wait in
  /// NodeAccess::next_cloud must be let go first.
  ~Services();
  Services(const Services&) = delete;
  Services& operator=(const Services&) = delete;

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace sks_detector
