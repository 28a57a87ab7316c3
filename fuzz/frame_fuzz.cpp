// SPDX-License-Identifier: BSD-3-Clause
// A whole frame of the node: any message, through every stage of the detector.
#include <sks_detector/detector.hpp>

#include "point_cloud_message.hpp"
#include "refused.hpp"
#include "ros/cloud_message.hpp"
#include "small_codebook.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const sks::Detector detector(std::make_shared<const sks::Codebook>(sks::fuzz::smallCodebook()),
                                      sks::fuzz::smallSettings());
  const sensor_msgs::PointCloud2 message = sks::fuzz::messageOf(data, size);
  sks::fuzz::refused([&] {
    for (const sks::Detection& detection : detector.detect(sks_detector::toCloud(message)).detections) {
      sks::fuzz::require(detection.score >= 0 && detection.score <= 1, "a score lies in [0, 1]");
      sks::fuzz::require(detection.T_scene_model.matrix().allFinite(), "a pose is finite");
    }
  });
  return 0;
}
