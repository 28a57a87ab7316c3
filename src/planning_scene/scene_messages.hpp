// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <moveit_msgs/PlanningScene.h>
#include <object_recognition_msgs/TableArray.h>
#include <sks_detector/DetectionArray.h>
#include <sks_detector/Support.h>

#include "planning_scene/scene_objects.hpp"

namespace sks_detector {

/// The detections with at least this score, but those whose poses or boxes are no numbers.
std::vector<SeenObject> seenObjects(const DetectionArray& detections, double min_score);

/// The box whose upper side is the plane. @param thickness [m] @return nothing where no plane was found
std::optional<SceneBox> supportBox(const Support& support, double thickness);

/// A change as a diff of a planning scene. An object that moved is added anew, which replaces it in every release of
/// MoveIt. @param header frame of the boxes
moveit_msgs::PlanningScene sceneDiff(const SceneChange& change, const std_msgs::Header& header);

/// One table, or none.
object_recognition_msgs::TableArray tablesOf(const Support& support);

}  // namespace sks_detector
