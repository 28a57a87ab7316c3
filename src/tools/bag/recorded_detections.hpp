// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include <sks_detector/detection.hpp>

#include "tools/bag/bag_file.hpp"

namespace sks::tools {

/// What was found in one cloud, or stands there in truth.
struct RecordedArray {
  std::string frame;     ///< without leading slash
  std::string codebook;  ///< name and checksum; empty for ground truth
  std::vector<Detection> detections;
  double processing_time = 0;  ///< [s]
};

/// The arrays of a topic by the stamps of their clouds.
struct RecordedDetections {
  std::string topic;
  std::map<ros::Time, RecordedArray> arrays;
  std::size_t repeated = 0;  ///< arrays with the stamp of an earlier one, left out: as when a bag was played in a loop
};

/// The topic of ground truth: the one given, else the one whose last part begins with "ground_truth"; empty where there
/// is none.
/// @throws Error(bad_data) where the given one does not exist, or several could be meant
std::string findGroundTruthTopic(const BagFile& bag, const std::string& given);

/// The topic of recorded detections: the one given, else the one that is no ground truth; empty where there is none.
/// @throws Error(bad_data) where the given one does not exist, or several could be meant
std::string findDetectionsTopic(const BagFile& bag, const std::string& given, const std::string& ground_truth);

/// @throws Error(bad_data) naming the topic, stamp and object of a detection that cannot be used; Error(bad_file)
RecordedDetections readDetections(const BagFile& bag, const std::string& topic);

/// The topic of clouds: the one given, else the only one.
/// @throws Error(bad_data) where there is none, or several
std::string findCloudTopic(const BagFile& bag, const std::string& name);

}  // namespace sks::tools
