// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <sks_detector/progress.hpp>

#include "tools/bag/bag_file.hpp"
#include "tools/bag/cloud_check.hpp"
#include "tools/bag/transform_check.hpp"

namespace sks::tools {

/// What a camera says about itself.
struct CameraInfoReport {
  std::string topic;
  std::size_t count = 0;
  std::uint32_t width = 0, height = 0;  ///< [px]
  double fx = 0;                        ///< [px]; 0: not calibrated
  std::string frame;
};

/// Arrays of detections, recorded or as ground truth.
struct DetectionsReport {
  std::string topic;
  std::size_t arrays = 0, detections = 0;
  std::size_t with_cloud = 0;  ///< arrays that have the stamp of a cloud
};

/// All that `sks bag info` says.
struct BagReport {
  ros::Time begin, end;  ///< of the recording
  std::vector<CloudCheck> clouds;
  std::vector<CameraInfoReport> cameras;
  std::vector<DetectionsReport> detections;
  TransformCheck transforms;
  Remarks remarks;

  /// Topics that hold at least one cloud that the node can use.
  std::vector<std::string> usableTopics() const;
};

/// Reads the whole bag. @throws Error(bad_file), Error(cancelled)
BagReport inspectBag(const BagFile& bag, const Progress& progress);

}  // namespace sks::tools
