// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/detection.hpp>

#include "io/dataset.hpp"

namespace sks {

/// How a detection counts.
enum class Outcome {
  true_positive,
  false_positive,
  ignored  ///< neither way: its object is on the scene's ignore list
};

/// How far a found pose is from the true one.
struct PoseError {
  double translation = 0;  ///< distance between where the two poses put the centre of the reference's box [m]
  double rotation = 0;     ///< angle between the two rotations [deg]
  double t_diff = 0;       ///< Frobenius norm of T_h - T_g (eq. 4), translations in metres
};

/// A detection and what became of it.
struct MatchedDetection {
  Detection detection;
  Outcome outcome = Outcome::false_positive;
  std::optional<std::size_t> ground_truth;  ///< of a true positive: index into Scene::objects
  std::optional<PoseError> pose_error;      ///< of a true positive whose pose is in the frame of the ground truth's
};

/// The matching rule. Per object, detections in descending score each take the nearest ground truth of their object
/// that is still free; within `max_distance` that makes a true positive, else a false positive (and it stays free).
/// The distance is that of the detection's box centre from the position of the ground truth. Where the ground truth is
/// also known in the detection's model frame (registeredTruth()), it is that of the same point of the object: the
/// centre of the reference's box, in the pose that was found. A detection of an object that is not in the scene is a
/// false positive. Since better detections choose first, the outcome of those above a threshold does not depend on
/// those below.
/// @param max_distance [m]
/// @return all detections, best first; equal scores by distance to the nearest ground truth of their object, then by
///         object and position, so that the order they come in does not matter
std::vector<MatchedDetection> matchScene(const Scene& scene, const std::vector<Detection>& detections,
                                         double max_distance);

/// Whether an object is on the scene's ignore list.
bool isIgnored(const Scene& scene, const std::string& object);

/// Compares a found pose with the true one of the same model frame.
/// @param position centre of the reference's box in the scene, as the true pose maps it [m]
/// @param symmetry of the object: of all its rotations that look the same the one that is nearest to the found pose is
/// true
PoseError poseError(const Eigen::Isometry3d& T_scene_found, const Eigen::Isometry3d& T_scene_true,
                    const Eigen::Vector3d& position, const std::optional<Symmetry>& symmetry = {});

}  // namespace sks
