// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Geometry>

namespace sks {

class Thresholds;

/// An object found in a cloud, in the frame of the cloud.
struct Detection {
  std::string object;  ///< name
  double score = 0;    ///< in [0, 1], comparable across scenes
  std::string view;    ///< what the model's frame is called: source of a training cloud or mesh
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();  ///< 6-D pose of that frame
  Eigen::Isometry3d T_scene_box = Eigen::Isometry3d::Identity();    ///< box centre, and axes
  Eigen::Vector3d box_size = Eigen::Vector3d::Zero();               ///< full extents along the box's axes [m]
  /// Covariance of the pose: shift of the model's origin [m], and rotation vector, along the axes of the scene; zeros:
  /// not known. What the cloud does not tell, like the turn of a bowl, has the deviation of what is possible. It
  /// says nothing of another pose that may be the right one, such as a carton's by half a turn.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  double density = 0;         ///< kernel sum of the inliers' votes at their maximum
  double evidence = 0;        ///< for the pose, from votes and surface or votes alone (docs/method.md)
  std::uint32_t votes = 0;    ///< votes at the maximum before RANSAC
  std::uint32_t inliers = 0;  ///< votes that agree on the pose

  /// The detection's position: the centre of its box.
  Eigen::Vector3d position() const { return T_scene_box.translation(); }
};

/// Wall-clock times of the stages of one detection [s].
struct StageTimes {
  double sanitize = 0, normals = 0, keypoints = 0, descriptors = 0, matching = 0, voting = 0, verification = 0;
  double total = 0;  ///< from the cloud in memory to the detections
};

/// What went through the stages of one detection.
struct StageCounts {
  std::size_t input_points = 0, points = 0, grid_keypoints = 0, keypoints = 0, descriptors = 0, votes = 0,
              hypotheses = 0;
};

/// Intermediate results of a detection, in the frame of the cloud, for people who look inside.
struct Inspection {
  std::vector<Eigen::Vector3f> keypoints;   ///< the kept ones [m]
  std::vector<Eigen::Vector3f> votes;       ///< where votes fell in the Hough spaces [m]
  std::vector<std::uint32_t> vote_objects;  ///< of each vote; index into Codebook::objects
};

struct DetectionResult {
  std::vector<Detection> detections;  ///< every hypothesis with its score, best first; ties by object, then position
  StageTimes times;
  StageCounts counts;

  /// Those with at least the given score.
  std::vector<Detection> above(double threshold) const;
  /// Those with at least the score that their object needs.
  std::vector<Detection> above(const Thresholds& thresholds) const;
};

}  // namespace sks
