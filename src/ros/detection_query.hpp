// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sks_detector/Detect.h>
#include <Eigen/Geometry>

#include <sks_detector/cloud.hpp>
#include <sks_detector/detection.hpp>
#include <sks_detector/detector.hpp>

namespace sks_detector {

/// A box in which detections are wanted.
struct Region {
  std::string frame;  ///< without a leading slash; empty: that of the cloud
  Eigen::Isometry3d T_frame_region = Eigen::Isometry3d::Identity();  ///< centre [m] and axes
  Eigen::Vector3d size = Eigen::Vector3d::Zero();                    ///< full edges along its axes [m]
};

/// What is wanted of the detections in a cloud.
struct DetectionQuery {
  std::vector<std::string> objects;  ///< names; empty: all
  std::optional<Region> region;
  std::optional<double> threshold;  ///< lowest score of all objects; none: the detector's
};

/// @throws sks::Error(bad_usage) naming the field, its value and unit where a number makes no sense
DetectionQuery toQuery(const Detect::Request& request);

/// @throws sks::Error(bad_usage) naming the nearest known name where a wanted object is not in the codebook
void checkObjects(const DetectionQuery& query, const sks::Codebook& codebook);

/// Detects, and keeps what is wanted. With a region only what may belong to an object there is searched: of a cloud
/// that is usable but has next to no points there nothing is found.
/// @param T_cloud_region pose of the region in the frame of the cloud; not used without one
/// @param inspection may be null
/// @return best first, in the frame of the cloud
/// @throws what sks::Detector::detect() throws
std::vector<sks::Detection> detectWanted(const sks::Detector& detector, const sks::Cloud& cloud,
                                         const DetectionQuery& query, const Eigen::Isometry3d& T_cloud_region,
                                         sks::Inspection* inspection);

}  // namespace sks_detector
