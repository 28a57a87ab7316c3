// SPDX-License-Identifier: BSD-3-Clause
#include "ros/detection_output.hpp"

#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>
#include <utility>

#include <geometry_msgs/TransformStamped.h>
#include <pcl_ros/transforms.h>
#include <ros/console.h>
#include <ros/init.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/image_encodings.h>
#include <tf2_msgs/TFMessage.h>

#include "ros/cloud_message.hpp"
#include "ros/detection_frame.hpp"
#include "ros/master_access.hpp"
#include "ros/support_message.hpp"

namespace sks_detector {
namespace {

// Markers are published again while they hold, so that they go by themselves where the node went without a word.
constexpr double marker_lifetime = 3.0, marker_period = 1.0;  // [s]

constexpr std::uint32_t transform_queue = 100;  // as tf2_ros has it

// Transforms of a stamp near the end of time make tf2, and so other nodes, throw.
constexpr double furthest_ahead = 3600;  // [s]

/// Detections in the order in which those of one object are numbered: followed ones keep their numbers while all are
/// seen, others are numbered by their score.
std::vector<std::size_t> numberedOrder(const DetectionArray& detections) {
  std::vector<std::size_t> order(detections.detections.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return detections.detections[a].id < detections.detections[b].id;
  });
  return order;
}

/// Publishes a cloud in the frame of the header, if somebody listens.
void publishCloud(const ros::Publisher& publisher, const sks::Cloud& cloud, const Eigen::Isometry3d& T_target_cloud,
                  const std_msgs::Header& header) {
  if (publisher.getNumSubscribers() == 0) return;
  sensor_msgs::PointCloud2 message = toMessage(cloud, header);
  if (!message.data.empty()) {
    const Eigen::Matrix4f T = T_target_cloud.matrix().cast<float>();
    pcl_ros::transformPointCloud(T, sensor_msgs::PointCloud2(message), message);
  }
  publisher.publish(message);
}

void publishPicture(const ros::Publisher& publisher, const sks::ColorImage& picture, const std_msgs::Header& header) {
  if (picture.pixels.empty()) return;
  sensor_msgs::Image message;
  message.header = header;
  message.width = std::uint32_t(picture.width);
  message.height = std::uint32_t(picture.height);
  message.encoding = sensor_msgs::image_encodings::RGB8;
  message.step = std::uint32_t(message.width * sizeof(sks::Rgb));
  static_assert(sizeof(sks::Rgb) == 3);
  message.data.resize(std::size_t(message.step) * message.height);
  std::memcpy(message.data.data(), picture.pixels.data(), message.data.size());
  publisher.publish(message);
}

}  // namespace

DetectionOutput::DetectionOutput(ros::NodeHandle& private_handle, std::function<void()> listeners_changed)
    : poses_(private_handle, listeners_changed), handle_(private_handle) {
  const ros::SubscriberStatusCallback changed = [listeners_changed = std::move(listeners_changed)](
                                                    const ros::SingleSubscriberPublisher&) { listeners_changed(); };
  detections_ = private_handle.advertise<DetectionArray>("detections", 10, changed, changed);
  markers_ = private_handle.advertise<visualization_msgs::MarkerArray>("markers", 1, changed, changed);
  keypoints_ = private_handle.advertise<sensor_msgs::PointCloud2>("keypoints", 1, changed, changed);
  votes_ = private_handle.advertise<sensor_msgs::PointCloud2>("votes", 1, changed, changed);
  picture_ = private_handle.advertise<sensor_msgs::Image>("image_overlay", 1, changed, changed);
  support_ = private_handle.advertise<Support>("support", 1, changed, changed);
  for (const MakeResultOutput& make : resultOutputs()) further_.push_back(make(private_handle, changed));
  keep_markers_ =
      private_handle.createTimer(ros::Duration(marker_period), [this](const ros::TimerEvent&) { keepMarkers(); });
}

DetectionOutput::~DetectionOutput() {
  keep_markers_.stop();
  clearMarkers();
  // what is published is sent by another thread, if the connections are still there
  if (ros::ok() && markers_.getNumSubscribers() > 0) ros::WallDuration(0.1).sleep();
}

bool DetectionOutput::listened() const {
  const FrameExtras extras = wantedExtras();
  return extras.inspection || extras.picture || extras.support || poses_.listened() ||
         detections_.getNumSubscribers() > 0 || markers_.getNumSubscribers() > 0 ||
         std::any_of(further_.begin(), further_.end(), [](const auto& output) { return output->listened(); });
}

FrameExtras DetectionOutput::wantedExtras() const {
  return {keypoints_.getNumSubscribers() > 0 || votes_.getNumSubscribers() > 0, picture_.getNumSubscribers() > 0,
          support_.getNumSubscribers() > 0};
}

void DetectionOutput::publish(const FrameResult& result, const NodeSettings& settings) {
  const DetectionArray& detections = result.detections;
  detections_.publish(detections);
  poses_.publish(detections);
  for (const auto& output : further_) output->publish(detections, result.places);
  {
    const std::lock_guard<std::mutex> lock(shown_mutex_);
    shown_ = detections;
    shown_style_ = {result.colors, result.T_target_sensor, ros::Duration(marker_lifetime)};
    publishMarkers();
  }
  publishCloud(keypoints_, result.keypoints, result.T_target_cloud, detections.header);
  publishCloud(votes_, result.votes, result.T_target_cloud, detections.header);
  publishPicture(picture_, result.picture, result.picture_header);
  if (result.support_sought && support_.getNumSubscribers() > 0) {
    support_.publish(toMessage(result.support, result.T_target_cloud, detections.header));
  }
  if (settings.publish_tf) broadcastPoses(detections, settings);
}

void DetectionOutput::advertiseTransforms(bool wanted) {
  const auto is_done = [&] {
    const std::lock_guard<std::mutex> lock(transforms_mutex_);
    return bool(transforms_) == wanted;
  };
  if (is_done() || !masterAnswers()) return;
  const std::lock_guard<std::mutex> lock(transforms_mutex_);
  if (wanted && !transforms_) transforms_ = handle_.advertise<tf2_msgs::TFMessage>("/tf", transform_queue);
  if (!wanted) transforms_ = ros::Publisher();
}

void DetectionOutput::clearMarkers() {
  const std::lock_guard<std::mutex> lock(shown_mutex_);
  shown_.detections.clear();
  markers_.publish(clearingMarkers(shown_.header));
}

void DetectionOutput::publishMarkers() {
  if (markers_.getNumSubscribers() > 0) markers_.publish(detectionMarkers(shown_, shown_style_));
}

void DetectionOutput::broadcastPoses(const DetectionArray& detections, const NodeSettings& settings) {
  const std::string& parent = detections.header.frame_id;
  if (parent.empty()) {
    ROS_ERROR_THROTTLE(30,
                       "detections are not broadcast on /tf: their cloud has no frame_id; set it in what publishes the "
                       "cloud");
    return;
  }
  if (detections.header.stamp.toSec() > ros::Time::now().toSec() + furthest_ahead) {
    ROS_ERROR_THROTTLE(30,
                       "detections are not broadcast on /tf: their cloud is stamped more than an hour in the future");
    return;
  }
  tf2_msgs::TFMessage message;
  std::map<std::string, int> count;
  for (const std::size_t index : numberedOrder(detections)) {
    const Detection& detection = detections.detections[index];
    geometry_msgs::TransformStamped transform;
    transform.header = detections.header;
    transform.child_frame_id = detectionFrame(settings, detection.object, ++count[detection.object]);
    if (transform.child_frame_id == parent) {
      ROS_ERROR_STREAM_THROTTLE(30, "a detection is not broadcast on /tf: its frame '"
                                        << parent << "' is that of the cloud; set ~tf_prefix or ~tf_frame");
      continue;
    }
    transform.transform.translation.x = detection.pose.pose.position.x;
    transform.transform.translation.y = detection.pose.pose.position.y;
    transform.transform.translation.z = detection.pose.pose.position.z;
    transform.transform.rotation = detection.pose.pose.orientation;
    message.transforms.push_back(transform);
  }
  const std::lock_guard<std::mutex> lock(transforms_mutex_);
  if (transforms_ && !message.transforms.empty()) transforms_.publish(message);
}

void DetectionOutput::keepMarkers() {
  const std::lock_guard<std::mutex> lock(shown_mutex_);
  if (!shown_.detections.empty()) publishMarkers();
}

}  // namespace sks_detector
