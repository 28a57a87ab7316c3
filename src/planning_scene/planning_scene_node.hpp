// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/service_server.h>
#include <ros/subscriber.h>
#include <sks_detector/DetectionArray.h>
#include <sks_detector/Support.h>
#include <std_srvs/Trigger.h>

#include "planning_scene/scene_objects.hpp"

namespace sks_detector {

/// Keeps MoveIt's planning scene in step with what a detector sees (docs/moveit.md): `~detections` and `~support` in,
/// diffs on `planning_scene` and tables on `table_array` out. All callbacks come by the queue of the handles, which one
/// thread serves.
class PlanningSceneNode {
public:
  PlanningSceneNode(ros::NodeHandle& handle, ros::NodeHandle& private_handle, const PlanningSceneSettings& settings);
  /// Removes what it added, where somebody listens.
  ~PlanningSceneNode();
  PlanningSceneNode(const PlanningSceneNode&) = delete;
  PlanningSceneNode& operator=(const PlanningSceneNode&) = delete;

private:
  void takeDetections(const DetectionArray& detections);
  void takeSupport(const Support& support);
  /// Begins anew where the frame is another, or time jumped back.
  void follow(const std_msgs::Header& header);
  bool clear(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  /// Who comes later gets all that is in the scene.
  void welcome(const ros::SingleSubscriberPublisher& subscriber) const;
  void apply(const SceneChange& change);

  PlanningSceneSettings settings_;
  SceneObjects objects_;
  std_msgs::Header last_;  // of what came
  ros::Publisher scene_, tables_;
  ros::ServiceServer clear_;
  ros::Subscriber detections_, support_;
};

/// Reads the private parameters; what is wrong is logged, and the default used.
PlanningSceneSettings readPlanningSceneSettings(const ros::NodeHandle& private_handle);

}  // namespace sks_detector
