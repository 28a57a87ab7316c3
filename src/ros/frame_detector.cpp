// SPDX-License-Identifier: BSD-3-Clause
#include "ros/frame_detector.hpp"

#include <algorithm>
#include <utility>

#include <sks_detector/error.hpp>
#include <sks_detector/thresholds.hpp>

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
  Eigen::Matrix<double, 6, 6> turned = Eigen::Matrix<double, 6, 6>::Zero();
  turned.topLeftCorner<3, 3>() = turned.bottomRightCorner<3, 3>() = T_target_cloud.linear();
  detection.covariance = turned * detection.covariance * turned.transpose();
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

std::uint32_t placeOf(const std::string& object, const std::vector<std::string>& objects) {
  return std::uint32_t(std::find(objects.begin(), objects.end(), object) - objects.begin());
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

Eigen::Isometry3d FrameDetector::regionPose(const std_msgs::Header& cloud, const NodeSettings& settings,
                                            const std::optional<Region>& region) const {
  if (!region) return Eigen::Isometry3d::Identity();
  if (region->frame.empty()) return region->T_frame_region;
  return transforms_.lookup(withoutSlash(cloud.frame_id), region->frame, cloud.stamp, settings.tf_timeout) *
         region->T_frame_region;
}

std::shared_ptr<const sks::Detector> FrameDetector::detector() const {
  auto detector = slot_.detector();
  if (detector) return detector;
  throw sks::Error(sks::ErrorCode::bad_usage,
                   "there is no codebook: set ~codebook, call ~load_codebook, or train one by ~train");
}

FrameResult FrameDetector::emptyAnswer(const std_msgs::Header& cloud, const NodeSettings& settings,
                                       const Eigen::Isometry3d& T_cloud_sensor, const sks::Codebook& codebook) const {
  FrameResult result;
  result.detections.header = answerHeader(cloud, settings);
  result.detections.codebook = nameWithChecksum(codebook);
  result.T_target_cloud = transforms_.lookup(result.detections.header.frame_id, withoutSlash(cloud.frame_id),
                                             cloud.stamp, settings.tf_timeout);
  result.T_target_sensor = result.T_target_cloud * T_cloud_sensor;
  result.picture_header = cloud;
  result.picture_header.frame_id = withoutSlash(settings.sensor_frame.empty() ? cloud.frame_id : settings.sensor_frame);
  return result;
}

FrameResult FrameDetector::detect(const sensor_msgs::PointCloud2& message, const NodeSettings& settings,
                                  const FrameExtras& extras, const DetectionQuery& query) const {
  const auto used = detector();
  checkObjects(query, used->codebook());
  sks::Cloud cloud = receivedCloud(message, settings.max_points);
  const Eigen::Isometry3d T_cloud_sensor = sensorPose(message.header, settings);
  cloud.sensor_origin = T_cloud_sensor.translation().cast<float>();
  sks::Inspection inspection;
  const Eigen::Isometry3d T_cloud_region = regionPose(message.header, settings, query.region);
  std::vector<sks::Detection> found =
      detectWanted(*used, cloud, query, T_cloud_region, extras.inspection ? &inspection : nullptr);

  // last: while detecting the transform had time to arrive
  FrameResult result = emptyAnswer(message.header, settings, T_cloud_sensor, used->codebook());
  result.keypoints = pointsCloud(std::move(inspection.keypoints));
  result.votes = pointsCloud(std::move(inspection.votes));
  result.votes.colors = voteColors(inspection);
  const std::vector<std::string>& objects = used->codebook().objects;
  if (extras.picture) result.picture = draw(cloud, T_cloud_sensor, found, objects);
  result.support_sought = extras.support;
  if (extras.support) result.support = sks::findSupport(cloud, found, used->settings().sanitize);
  for (sks::Detection& detection : found) {
    transform(result.T_target_cloud, detection);
    result.detections.detections.push_back(toMessage(detection));
    result.colors.push_back(sks::objectColor(objects, detection.object));
    result.places.push_back(placeOf(detection.object, objects));
  }
  return result;
}

std::optional<Eigen::Isometry3d> FrameDetector::fixedPose(const std_msgs::Header& cloud,
                                                          const NodeSettings& settings) const {
  if (settings.fixed_frame.empty()) return std::nullopt;
  return transforms_.lookup(withoutSlash(settings.fixed_frame), withoutSlash(cloud.frame_id), cloud.stamp,
                            settings.tf_timeout);
}

sks::CloudView FrameDetector::viewOf(const std_msgs::Header& cloud, const NodeSettings& settings,
                                     std::string& warning) const {
  sks::CloudView view{cloud.stamp.toSec(), {}};
  try {
    view.T_fixed_cloud = fixedPose(cloud, settings);
  } catch (const sks::Error& error) {
    warning = std::string("objects are followed as if the camera stood still: ") + error.what();
  }
  return view;
}

FrameResult FrameDetector::follow(const sensor_msgs::PointCloud2& message, const NodeSettings& settings,
                                  const FrameExtras& extras, ObjectTracking& tracking) const {
  const auto used = detector();
  const Eigen::Isometry3d T_cloud_sensor = sensorPose(message.header, settings);
  std::string warning;
  const sks::CloudView view = viewOf(message.header, settings, warning);
  const auto cloud = std::make_shared<sks::Cloud>(receivedCloud(message, settings.max_points));
  cloud->sensor_origin = T_cloud_sensor.translation().cast<float>();
  const std::vector<sks::TrackedObject> tracked = tracking.follow(used, cloud, view);

  FrameResult result = emptyAnswer(message.header, settings, T_cloud_sensor, used->codebook());
  result.warning = std::move(warning);
  const std::vector<std::string>& objects = used->codebook().objects;
  const sks::Thresholds thresholds(used->settings().detection);
  std::vector<sks::Detection> shown;
  for (const sks::TrackedObject& object : tracked) {
    if (!thresholds.passes(object.detection)) continue;
    shown.push_back(object.detection);
    sks::Detection detection = object.detection;
    transform(result.T_target_cloud, detection);
    result.detections.detections.push_back(toMessage(detection));
    result.detections.detections.back().id = object.id;
    result.detections.detections.back().tracked = true;
    result.colors.push_back(sks::objectColor(objects, detection.object));
    result.places.push_back(placeOf(detection.object, objects));
  }
  if (extras.picture) result.picture = draw(*cloud, T_cloud_sensor, shown, objects);
  result.support_sought = extras.support;
  if (extras.support) result.support = sks::findSupport(*cloud, shown, used->settings().sanitize);
  return result;
}

std_msgs::Header FrameDetector::answerHeader(const std_msgs::Header& cloud, const NodeSettings& settings) {
  std_msgs::Header header = cloud;
  header.frame_id = withoutSlash(settings.target_frame.empty() ? cloud.frame_id : settings.target_frame);
  return header;
}

}  // namespace sks_detector
