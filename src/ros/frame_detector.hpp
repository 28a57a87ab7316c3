// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <sensor_msgs/PointCloud2.h>
#include <sks_detector/DetectionArray.h>
#include <std_msgs/Header.h>
#include <Eigen/Geometry>

#include <sks_detector/cloud.hpp>
#include <sks_detector/codebook.hpp>
#include <sks_detector/detector.hpp>
#include <sks_detector/support.hpp>
#include <sks_detector/tracker.hpp>

#include "io/image_file.hpp"
#include "ros/detection_query.hpp"
#include "ros/detector_slot.hpp"
#include "ros/node_settings.hpp"
#include "ros/object_tracking.hpp"
#include "ros/transforms.hpp"

namespace sks_detector {

/// What is wanted of a cloud beside its detections.
struct FrameExtras {
  bool inspection = false;  ///< keypoints and votes
  bool picture = false;
  bool support = false;  ///< the plane that things stand on
};

/// What one cloud led to.
struct FrameResult {
  DetectionArray detections;  ///< in ~target_frame
  sks::Cloud keypoints;       ///< in the cloud's frame; empty where they were not asked for, like the votes
  sks::Cloud votes;           ///< in the cloud's frame, in the colours of their objects
  sks::ColorImage picture;    ///< of the cloud with what was found, as its camera sees it; empty where not asked for
  std_msgs::Header picture_header;  ///< of the camera's frame
  bool support_sought = false;
  std::optional<sks::Support> support;  ///< in the cloud's frame; empty where there is none, or it was not sought
  std::vector<sks::Rgb> colors;         ///< of each detection: that of its object in the codebook
  std::vector<std::uint32_t> places;    ///< of each detection: that of its object in the codebook
  Eigen::Isometry3d T_target_cloud = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_target_sensor = Eigen::Isometry3d::Identity();  ///< the camera: x right, y down, z forward
  std::string warning;  ///< what did not work as it was asked for; else empty
};

/// From a cloud's message to detections, with the detector that is in the slot at the moment. Safe to use from several
/// threads.
class FrameDetector {
public:
  /// @param slot, transforms must outlive it
  FrameDetector(const DetectorSlot& slot, Transforms& transforms) : slot_(slot), transforms_(transforms) {}

  /// The cloud in its own frame, with the position of the camera.
  /// @throws sks::Error for an unusable cloud, or where a transform is missing
  sks::Cloud read(const sensor_msgs::PointCloud2& cloud, const NodeSettings& settings) const;

  /// T_fixed_cloud: pose of a cloud's frame in ~fixed_frame; none without ~fixed_frame.
  /// @throws sks::Error where the transform is missing
  std::optional<Eigen::Isometry3d> fixedPose(const std_msgs::Header& cloud, const NodeSettings& settings) const;

  /// @throws sks::Error without a codebook, for an unusable cloud, where a transform is missing, or for objects that
  /// the codebook does not have
  FrameResult detect(const sensor_msgs::PointCloud2& cloud, const NodeSettings& settings, const FrameExtras& extras,
                     const DetectionQuery& query = {}) const;

  /// The same by following what earlier clouds showed (~tracking). Where the transform to ~fixed_frame is missing,
  /// objects are followed in the frame of the cloud, and the result says so. Keypoints and votes are empty.
  FrameResult follow(const sensor_msgs::PointCloud2& cloud, const NodeSettings& settings, const FrameExtras& extras,
                     ObjectTracking& tracking) const;

  /// The header of the answer to a cloud: its stamp, in ~target_frame or the cloud's own frame.
  static std_msgs::Header answerHeader(const std_msgs::Header& cloud, const NodeSettings& settings);

private:
  /// The detector in the slot. @throws sks::Error without a codebook
  std::shared_ptr<const sks::Detector> detector() const;
  /// All of an answer but its detections.
  FrameResult emptyAnswer(const std_msgs::Header& cloud, const NodeSettings& settings,
                          const Eigen::Isometry3d& T_cloud_sensor, const sks::Codebook& codebook) const;
  sks::CloudView viewOf(const std_msgs::Header& cloud, const NodeSettings& settings, std::string& warning) const;
  /// T_cloud_region; identity without a region. @throws sks::Error where the transform is missing
  Eigen::Isometry3d regionPose(const std_msgs::Header& cloud, const NodeSettings& settings,
                               const std::optional<Region>& region) const;
  /// T_cloud_sensor. @throws sks::Error where the transform is missing
  Eigen::Isometry3d sensorPose(const std_msgs::Header& cloud, const NodeSettings& settings) const;

  const DetectorSlot& slot_;
  Transforms& transforms_;
};

}  // namespace sks_detector
