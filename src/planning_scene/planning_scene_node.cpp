// SPDX-License-Identifier: BSD-3-Clause
#include "planning_scene/planning_scene_node.hpp"

#include <algorithm>

#include <ros/console.h>
#include <ros/init.h>
#include <ros/single_subscriber_publisher.h>

#include "core/settings/settings_table.hpp"
#include "planning_scene/scene_messages.hpp"
#include "ros/parameter_tree.hpp"

namespace sks_detector {
namespace {

constexpr std::uint32_t scene_queue = 100;  // diffs: none may be lost
constexpr std::uint32_t input_queue = 10;
constexpr double out_of_order = 1.0;   // [s] what is older than the last by less came late
constexpr double farewell_time = 0.3;  // [s] for the last diff, which another thread sends

}  // namespace

PlanningSceneSettings readPlanningSceneSettings(const ros::NodeHandle& private_handle) {
  static const sks::SettingsTable<PlanningSceneSettings> table;
  PlanningSceneSettings settings;
  sks::SettingsOverlay overlay({table.bind(settings)});
  const TreeReading reading =
      overlayParameters(readParameterTree(private_handle), private_handle.getNamespace(), overlay);
  for (const std::string& warning : reading.warnings) ROS_WARN_STREAM(warning);
  for (const TreeReading::Refused& refused : reading.refused) {
    ROS_ERROR_STREAM(refused.message << "; the default " << table.at(refused.key).default_value << " is used");
  }
  return settings;
}

PlanningSceneNode::PlanningSceneNode(ros::NodeHandle& handle, ros::NodeHandle& private_handle,
                                     const PlanningSceneSettings& settings)
    : settings_(settings), objects_(settings) {
  scene_ = handle.advertise<moveit_msgs::PlanningScene>(
      "planning_scene", scene_queue, [this](const ros::SingleSubscriberPublisher& subscriber) { welcome(subscriber); });
  tables_ = handle.advertise<object_recognition_msgs::TableArray>("table_array", 1);
  clear_ = private_handle.advertiseService("clear", &PlanningSceneNode::clear, this);
  detections_ = private_handle.subscribe<DetectionArray>(
      "detections", input_queue, [this](const DetectionArrayConstPtr& message) { takeDetections(*message); });
  if (!settings_.support) return;
  support_ = private_handle.subscribe<Support>("support", input_queue,
                                               [this](const SupportConstPtr& message) { takeSupport(*message); });
}

PlanningSceneNode::~PlanningSceneNode() {
  detections_.shutdown();
  support_.shutdown();
  if (!ros::ok() || scene_.getNumSubscribers() == 0) return;
  apply(objects_.clear());
  ros::WallDuration(farewell_time).sleep();
}

void PlanningSceneNode::takeDetections(const DetectionArray& detections) {
  follow(detections.header);
  apply(objects_.takeObjects(detections.header.stamp.toSec(), seenObjects(detections, settings_.min_score)));
}

void PlanningSceneNode::takeSupport(const Support& support) {
  follow(support.header);
  apply(objects_.takeSupport(support.header.stamp.toSec(), supportBox(support, settings_.support_thickness)));
  tables_.publish(tablesOf(support));
}

void PlanningSceneNode::follow(const std_msgs::Header& header) {
  if (header.frame_id.empty()) {
    ROS_WARN_THROTTLE(30,
                      "detections come without a frame_id, so that MoveIt cannot tell where they are; set it in what "
                      "publishes the cloud");
  }
  const bool is_first = last_.frame_id.empty();
  const bool other_frame = header.frame_id != last_.frame_id;
  const bool jumped_back = header.stamp.toSec() < last_.stamp.toSec() - out_of_order;
  if (!is_first && (other_frame || jumped_back)) {
    ROS_WARN_STREAM("the planning scene is begun anew: " << (other_frame
                                                                 ? "detections come in the frame '" + header.frame_id +
                                                                       "', no longer in '" + last_.frame_id + "'"
                                                                 : std::string("time jumped back")));
    apply(objects_.clear());
    last_.stamp = header.stamp;
  }
  last_.frame_id = header.frame_id;
  last_.stamp = std::max(last_.stamp, header.stamp);
}

bool PlanningSceneNode::clear(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  const SceneChange change = objects_.clear();
  apply(change);
  response.success = true;
  response.message = "removed " + std::to_string(change.removed.size()) + " objects";
  if (scene_.getNumSubscribers() == 0) response.message += "; nobody listens to " + scene_.getTopic();
  return true;
}

void PlanningSceneNode::welcome(const ros::SingleSubscriberPublisher& subscriber) const {
  const SceneChange everything{objects_.all(), {}};
  if (!everything.empty()) subscriber.publish(sceneDiff(everything, last_));
}

void PlanningSceneNode::apply(const SceneChange& change) {
  if (change.empty()) return;
  scene_.publish(sceneDiff(change, last_));
}

}  // namespace sks_detector
