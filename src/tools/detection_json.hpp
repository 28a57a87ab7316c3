// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include <sks_detector/detection.hpp>

namespace sks::tools {

/// Keys object, score, position [m], pose (16 numbers, row-major, T_scene_model), box (center and size [m], orientation
/// as quaternion x y z w), view, density, votes, inliers.
nlohmann::json detectionJson(const Detection& detection);

/// The 16 numbers of a pose, row-major.
nlohmann::json poseJson(const Eigen::Isometry3d& pose);

/// Three numbers.
nlohmann::json vectorJson(const Eigen::Vector3d& vector);

/// Milliseconds of each stage by its name.
nlohmann::json timesJson(const StageTimes& times);

/// What went through the stages, by name.
nlohmann::json countsJson(const StageCounts& counts);

}  // namespace sks::tools
