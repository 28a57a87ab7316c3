// SPDX-License-Identifier: BSD-3-Clause
#include "ros/detection_message.hpp"

#include <cmath>
#include <optional>

#include <sks_detector/error.hpp>

namespace sks_detector {
namespace {

using RowMajor6d = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;  // as messages have it

/// Nothing where the quaternion is zero.
std::optional<Eigen::Isometry3d> poseOf(const geometry_msgs::Pose& message) {
  const auto& q = message.orientation;
  Eigen::Quaterniond rotation(q.w, q.x, q.y, q.z);
  if (rotation.norm() == 0) return std::nullopt;
  rotation.normalize();
  return Eigen::Translation3d(message.position.x, message.position.y, message.position.z) * rotation;
}

}  // namespace

geometry_msgs::Pose toMessage(const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond rotation(pose.linear());
  geometry_msgs::Pose message;
  message.position.x = pose.translation().x();
  message.position.y = pose.translation().y();
  message.position.z = pose.translation().z();
  message.orientation.x = rotation.x();
  message.orientation.y = rotation.y();
  message.orientation.z = rotation.z();
  message.orientation.w = rotation.w();
  return message;
}

Detection toMessage(const sks::Detection& detection) {
  Detection message;
  message.object = detection.object;
  message.score = float(detection.score);
  message.pose.pose = toMessage(detection.T_scene_model);
  Eigen::Map<RowMajor6d>(message.pose.covariance.data()) = detection.covariance;
  message.box_center = toMessage(detection.T_scene_box);
  message.box_size.x = detection.box_size.x();
  message.box_size.y = detection.box_size.y();
  message.box_size.z = detection.box_size.z();
  message.votes = detection.votes;
  message.inliers = detection.inliers;
  message.view = detection.view;
  return message;
}

sks::Detection toDetection(const Detection& message) {
  const std::optional<Eigen::Isometry3d> pose = poseOf(message.pose.pose), box = poseOf(message.box_center);
  const auto refuse = [&](const std::string& what) {
    throw sks::Error(sks::ErrorCode::bad_data, "detection of '" + message.object + "': " + what);
  };
  if (!pose && !box) refuse("neither its pose nor its box_center is set: both have a quaternion of zeros");
  sks::Detection detection;
  detection.object = message.object;
  detection.score = double(message.score);
  detection.view = message.view;
  detection.T_scene_model = pose.value_or(box.value_or(Eigen::Isometry3d::Identity()));
  const Eigen::Map<const RowMajor6d> covariance(message.pose.covariance.data());
  if (covariance.allFinite()) detection.covariance = covariance;
  detection.T_scene_box = box.value_or(detection.T_scene_model);
  detection.box_size = {message.box_size.x, message.box_size.y, message.box_size.z};
  detection.votes = message.votes;
  detection.inliers = message.inliers;
  const bool finite = detection.T_scene_model.matrix().allFinite() && detection.T_scene_box.matrix().allFinite() &&
                      detection.box_size.allFinite() && std::isfinite(detection.score);
  if (!finite) refuse("a number of its pose, box or score is not finite");
  return detection;
}

}  // namespace sks_detector
