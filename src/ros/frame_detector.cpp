// SPDX-License-Identifier: BSD-3-Clause
#include "ros/frame_detector.hpp"

#include <utility>

#include <sks_detector/error.hpp>

#include "drawing/palette.hpp"
#include "drawing/picture.hpp"
#include "ros/cloud_message.hpp"
#include "ros/detection_message.hpp"
#include "ros/frame_name.hpp"

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

std::vector<sks::Rgb> voteColors(const sks::Inspection& inspection) {
  std::vector<sks::Rgb> colors;
  for (const std::uint32_t object : inspection.vote_objects) colors.push_back(sks::paletteColor(object));
  return colors;
}

/// As `sks detect --image` draws it, in the size of most depth images.
sks::ColorImage draw(sks::Cloud cloud, const Eigen::Isometry3d& T_cloud_sensor, std::vector<sks::Detection> detections,
                     const std::vector<std::string>& objects) {
  constexpr sks::PictureSize size{640, 480};
  const Eigen::Isometry3d T_sensor_cloud = T_cloud_sensor.inverse();
  const Eigen::Isometry3f T = T_sensor_cloud.cast<float>();
  for (Eigen::Vector3f& point : cloud.points) point = T * point;
  cloud.sensor_origin.setZero();
  sks::Picture picture(cloud, size);
  for (auto d = detections.rbegin(); d != detections.rend(); ++d) {  // the best on top
    transform(T_sensor_cloud, *d);
    picture.drawDetection(*d, sks::objectColor(objects, d->object));
  }
  return picture.image();
}

}  // namespace

sks::Cloud FrameDetector::read(const sensor_msgs::PointCloud2& message, const NodeSettings& settings) const {
  sks::Cloud cloud = receivedCloud(message, settings.max_points);
  cloud.sensor_origin = sensorPose(message.header, settings).translation().cast<float>();
  return cloud;
}

Eigen::Isometry3d FrameDetector::sensorPose(const std_msgs::Header& cloud, const NodeSettings& settings) const {
  if (settings.sensor_frame.empty()) return Eigen::Isometry3d::Identity();
  return transforms_.lookup(withoutSlash(cloud.frame_id), withoutSlash(settings.sensor_frame), cloud.stamp,
                            settings.tf_timeout);
}

FrameResult FrameDetector::detect(const sensor_msgs::PointCloud2& message, const NodeSettings& settings,
                                  const FrameExtras& extras) const {
  const auto detector = slot_.detector();
  if (!detector) {
    throw sks::Error(sks::ErrorCode::bad_usage,
                     "there is no codebook: set ~codebook, call ~load_codebook, or train one by ~train");
  }
  sks::Cloud cloud = receivedCloud(message, settings.max_points);
  const Eigen::Isometry3d T_cloud_sensor = sensorPose(message.header, settings);
  cloud.sensor_origin = T_cloud_sensor.translation().cast<float>();
  sks::Inspection inspection;
  const double threshold = detector->settings().detection.threshold;
  std::vector<sks::Detection> found =
      detector->detect(cloud, extras.inspection ? &inspection : nullptr).above(threshold);

  FrameResult result;
  DetectionArray& answer = result.detections;
  answer.header = answerHeader(message.header, settings);
  answer.codebook = nameWithChecksum(detector->codebook());
  // looked up last: while detecting the transform had time to arrive
  result.T_target_cloud = transforms_.lookup(answer.header.frame_id, withoutSlash(message.header.frame_id),
                                             message.header.stamp, settings.tf_timeout);
  result.T_target_sensor = result.T_target_cloud * T_cloud_sensor;
  result.keypoints = pointsCloud(std::move(inspection.keypoints));
  result.votes = pointsCloud(std::move(inspection.votes));
  result.votes.colors = voteColors(inspection);
  result.picture_header = message.header;
  result.picture_header.frame_id =
      withoutSlash(settings.sensor_frame.empty() ? message.header.frame_id : settings.sensor_frame);
  if (extras.picture) result.picture = draw(cloud, T_cloud_sensor, found, detector->codebook().objects);
  for (sks::Detection& detection : found) {
    transform(result.T_target_cloud, detection);
    answer.detections.push_back(toMessage(detection));
    result.colors.push_back(sks::objectColor(detector->codebook().objects, detection.object));
  }
  return result;
}

std_msgs::Header FrameDetector::answerHeader(const std_msgs::Header& cloud, const NodeSettings& settings) {
  std_msgs::Header header = cloud;
  header.frame_id = withoutSlash(settings.target_frame.empty() ? cloud.frame_id : settings.target_frame);
  return header;
}

}  // namespace sks_detector
