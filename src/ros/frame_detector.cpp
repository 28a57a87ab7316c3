// SPDX-License-Identifier: BSD-3-Clause
#include "ros/frame_detector.hpp"

#include <utility>

#include <sks_detector/error.hpp>

#include "ros/cloud_message.hpp"
#include "ros/detection_message.hpp"
#include "ros/frame_name.hpp"
#include "ros/markers.hpp"

namespace sks_detector {
namespace {

void transform(const Eigen::Isometry3d& T_target_cloud, sks::Detection& detection) {
  detection.T_scene_model = T_target_cloud * detection.T_scene_model;
  detection.T_scene_box = T_target_cloud * detection.T_scene_box;
}

sks::Cloud pointsCloud(std::vector<Eigen::Vector3f> points) {
  sks::Cloud cloud;
  cloud.width = std::uint32_t(points.size());
  cloud.points = std::move(points);
  return cloud;
}

std::vector<sks::Rgb> voteColors(const sks::Inspection& inspection, const std::vector<std::string>& objects) {
  std::vector<sks::Rgb> palette, colors;
  for (const std::string& object : objects) palette.push_back(objectColor(object));
  for (const std::uint32_t object : inspection.vote_objects) colors.push_back(palette.at(object));
  return colors;
}

}  // namespace

sks::Cloud FrameDetector::read(const sensor_msgs::PointCloud2& message, const NodeSettings& settings) const {
  sks::Cloud cloud = receivedCloud(message, settings.max_points);
  if (settings.sensor_frame.empty()) return cloud;
  const Eigen::Isometry3d T_cloud_sensor =
      transforms_.lookup(withoutSlash(message.header.frame_id), withoutSlash(settings.sensor_frame),
                         message.header.stamp, settings.tf_timeout);
  cloud.sensor_origin = T_cloud_sensor.translation().cast<float>();
  return cloud;
}

FrameResult FrameDetector::detect(const sensor_msgs::PointCloud2& message, const NodeSettings& settings,
                                  bool inspect) const {
  const auto detector = slot_.detector();
  if (!detector) {
    throw sks::Error(sks::ErrorCode::bad_usage,
                     "there is no codebook: set ~codebook, call ~load_codebook, or train one by ~train");
  }
  const sks::Cloud cloud = read(message, settings);
  sks::Inspection inspection;
  const double threshold = detector->settings().detection.threshold;
  std::vector<sks::Detection> found = detector->detect(cloud, inspect ? &inspection : nullptr).above(threshold);

  FrameResult result;
  DetectionArray& answer = result.detections;
  answer.header = answerHeader(message.header, settings);
  answer.codebook = nameWithChecksum(detector->codebook());
  // looked up last: while detecting the transform had time to arrive
  result.T_target_cloud = transforms_.lookup(answer.header.frame_id, withoutSlash(message.header.frame_id),
                                             message.header.stamp, settings.tf_timeout);
  result.keypoints = pointsCloud(std::move(inspection.keypoints));
  result.votes = pointsCloud(std::move(inspection.votes));
  result.votes.colors = voteColors(inspection, detector->codebook().objects);
  for (sks::Detection& detection : found) {
    transform(result.T_target_cloud, detection);
    answer.detections.push_back(toMessage(detection));
  }
  return result;
}

std_msgs::Header FrameDetector::answerHeader(const std_msgs::Header& cloud, const NodeSettings& settings) {
  std_msgs::Header header = cloud;
  header.frame_id = withoutSlash(settings.target_frame.empty() ? cloud.frame_id : settings.target_frame);
  return header;
}

}  // namespace sks_detector
