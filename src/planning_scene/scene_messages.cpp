// SPDX-License-Identifier: BSD-3-Clause
#include "planning_scene/scene_messages.hpp"

#include <algorithm>
#include <cmath>

#include <ros/console.h>

#include <sks_detector/error.hpp>

#include "ros/detection_message.hpp"

namespace sks_detector {
namespace {

constexpr double least_edge = 0.001;  // [m] a box of less is none to MoveIt

moveit_msgs::CollisionObject removal(const std::string& id, const std_msgs::Header& header) {
  moveit_msgs::CollisionObject object;
  object.header = header;
  object.pose.orientation.w = 1;
  object.id = id;
  object.operation = moveit_msgs::CollisionObject::REMOVE;
  return object;
}

/// The box's pose is that of the shape, not of the object: so all releases of MoveIt understand it.
moveit_msgs::CollisionObject addition(const SceneObject& object, const std_msgs::Header& header) {
  moveit_msgs::CollisionObject message;
  message.header = header;
  message.pose.orientation.w = 1;
  message.id = object.id;
  message.type.key = object.name;
  shape_msgs::SolidPrimitive box;
  box.type = shape_msgs::SolidPrimitive::BOX;
  for (int axis = 0; axis < 3; ++axis) box.dimensions.push_back(std::max(least_edge, object.box.size[axis]));
  message.primitives.push_back(box);
  message.primitive_poses.push_back(toMessage(object.box.T_scene_box));
  message.operation = moveit_msgs::CollisionObject::ADD;
  return message;
}

}  // namespace

std::vector<SeenObject> seenObjects(const DetectionArray& detections, double min_score) {
  std::vector<SeenObject> seen;
  for (const Detection& message : detections.detections) {
    if (!(double(message.score) >= min_score)) continue;
    try {
      const sks::Detection detection = toDetection(message);
      seen.push_back({message.id, message.object, {detection.T_scene_box, detection.box_size}});
    } catch (const sks::Error& error) {
      ROS_WARN_STREAM_THROTTLE(10, "a detection is not added to the planning scene: " << error.what());
    }
  }
  return seen;
}

std::optional<SceneBox> supportBox(const Support& support, double thickness) {
  if (!support.found) return std::nullopt;
  const geometry_msgs::Pose& pose = support.pose;
  const Eigen::Quaterniond rotation(pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z);
  const Eigen::Vector3d middle(pose.position.x, pose.position.y, pose.position.z);
  const double numbers = rotation.norm() + middle.norm() + support.size_x + support.size_y;
  if (!std::isfinite(numbers) || rotation.norm() == 0) {
    ROS_WARN_STREAM_THROTTLE(10, "the support is not added to the planning scene: its pose or size is no number");
    return std::nullopt;
  }
  SceneBox box;
  box.T_scene_box = Eigen::Translation3d(middle) * rotation.normalized() * Eigen::Translation3d(0, 0, -0.5 * thickness);
  box.size = {support.size_x, support.size_y, thickness};
  return box;
}

moveit_msgs::PlanningScene sceneDiff(const SceneChange& change, const std_msgs::Header& header) {
  moveit_msgs::PlanningScene scene;
  scene.is_diff = true;
  scene.robot_state.is_diff = true;  // else the robot would be taken to stand in its zero position
  for (const std::string& id : change.removed) scene.world.collision_objects.push_back(removal(id, header));
  for (const SceneObject& object : change.put) scene.world.collision_objects.push_back(addition(object, header));
  return scene;
}

object_recognition_msgs::TableArray tablesOf(const Support& support) {
  object_recognition_msgs::TableArray tables;
  tables.header = support.header;
  if (!support.found) return tables;
  object_recognition_msgs::Table table;
  table.header = support.header;
  table.pose = support.pose;
  for (const geometry_msgs::Point32& corner : support.outline) {
    geometry_msgs::Point point;
    point.x = double(corner.x);
    point.y = double(corner.y);
    table.convex_hull.push_back(point);
  }
  tables.tables.push_back(table);
  return tables;
}

}  // namespace sks_detector
