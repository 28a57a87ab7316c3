// SPDX-License-Identifier: BSD-3-Clause
#include "tools/detection_json.hpp"

#include "evaluation/evaluation.hpp"

namespace sks::tools {
namespace {

nlohmann::json boxJson(const Detection& detection) {
  const Eigen::Quaterniond q(detection.T_scene_box.linear());
  return {{"center", vectorJson(detection.position())},
          {"orientation", {q.x(), q.y(), q.z(), q.w()}},
          {"size", vectorJson(detection.box_size)}};
}

/// Of x, y, z [m^2] and rotations about these axes [rad^2], row by row, as in geometry_msgs/PoseWithCovariance.
nlohmann::json covarianceJson(const Detection& detection) {
  nlohmann::json json = nlohmann::json::array();
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) json.push_back(detection.covariance(row, column));
  }
  return json;
}

}  // namespace

nlohmann::json detectionJson(const Detection& detection) {
  return {{"object", detection.object},
          {"score", detection.score},
          {"position", vectorJson(detection.position())},
          {"pose", poseJson(detection.T_scene_model)},
          {"covariance", covarianceJson(detection)},
          {"box", boxJson(detection)},
          {"view", detection.view},
          {"density", detection.density},
          {"votes", detection.votes},
          {"inliers", detection.inliers}};
}

nlohmann::json poseJson(const Eigen::Isometry3d& pose) {
  nlohmann::json json = nlohmann::json::array();
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) json.push_back(pose.matrix()(row, column));
  }
  return json;
}

nlohmann::json vectorJson(const Eigen::Vector3d& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

nlohmann::json timesJson(const StageTimes& times) {
  nlohmann::json json;
  for (const auto& [name, seconds] : namedTimes(times)) json[name] = 1000 * seconds;
  return json;
}

nlohmann::json countsJson(const StageCounts& counts) {
  return {{"input_points", counts.input_points},     {"points", counts.points},
          {"grid_keypoints", counts.grid_keypoints}, {"keypoints", counts.keypoints},
          {"descriptors", counts.descriptors},       {"votes", counts.votes},
          {"hypotheses", counts.hypotheses}};
}

}  // namespace sks::tools
