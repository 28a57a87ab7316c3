// SPDX-License-Identifier: BSD-3-Clause
#include "tools/bag/bag_report.hpp"

#include <algorithm>
#include <set>
#include <tuple>

#include <sensor_msgs/CameraInfo.h>
#include <sks_detector/DetectionArray.h>

#include "ros/frame_name.hpp"

namespace sks::tools {
namespace {

using sks_detector::withoutSlash;

CloudCheck checkClouds(const BagFile& bag, const BagTopic& topic, const Progress& progress) {
  CloudCheck check(topic.name);
  bag.forEach<sensor_msgs::PointCloud2>(topic.name, [&](const auto& message, const ros::Time& recorded) {
    report(progress, {"reading", topic.name, check.count(), topic.messages});
    check.add(message, recorded);
  });
  return check;
}

CameraInfoReport checkCamera(const BagFile& bag, const std::string& topic) {
  CameraInfoReport camera;
  camera.topic = topic;
  bag.forEach<sensor_msgs::CameraInfo>(topic, [&](const sensor_msgs::CameraInfo& info, const ros::Time&) {
    ++camera.count;
    camera.width = info.width;
    camera.height = info.height;
    camera.fx = info.K[0];
    camera.frame = info.header.frame_id;
  });
  return camera;
}

DetectionsReport checkDetections(const BagFile& bag, const std::string& topic, const std::set<ros::Time>& clouds) {
  DetectionsReport detections;
  detections.topic = topic;
  bag.forEach<sks_detector::DetectionArray>(topic, [&](const auto& array, const ros::Time&) {
    ++detections.arrays;
    detections.detections += array.detections.size();
    detections.with_cloud += clouds.count(array.header.stamp);
  });
  return detections;
}

void remarkOnCamera(const CameraInfoReport& camera, const std::vector<CloudCheck>& clouds, Remarks& remarks) {
  const auto add = [&](Severity severity, const std::string& message) {
    remarks.push_back({severity, camera.topic, message});
  };
  if (camera.count > 0 && !(camera.fx > 0)) {
    add(Severity::warning, "the camera is not calibrated: K is 0, so that no cloud can be made of its images");
  }
  for (const CloudCheck& cloud : clouds) {
    if (!cloud.organized() || camera.count == 0) continue;
    const bool same_camera = std::any_of(cloud.frames().begin(), cloud.frames().end(), [&](const std::string& frame) {
      return withoutSlash(frame) == withoutSlash(camera.frame);
    });
    if (same_camera && (cloud.width() != camera.width || cloud.height() != camera.height)) {
      add(Severity::warning, "it says " + std::to_string(camera.width) + " x " + std::to_string(camera.height) +
                                 " pixels, the clouds of " + cloud.topic() + " are " + std::to_string(cloud.width()) +
                                 " x " + std::to_string(cloud.height()));
    }
  }
}

void remarkOnDetections(const DetectionsReport& detections, Remarks& remarks) {
  if (detections.with_cloud == detections.arrays) return;
  remarks.push_back({Severity::note, detections.topic,
                     shareText(detections.arrays - detections.with_cloud, detections.arrays, "arrays") +
                         " have the stamp of no cloud in this bag"});
}

void remarkOnWhatIsMissing(const BagFile& bag, Remarks& remarks) {
  const std::vector<std::string> images = bag.topicsOf("sensor_msgs/Image");
  if (!bag.topicsOf("sensor_msgs/PointCloud2").empty()) return;
  std::string message = "there is no sensor_msgs/PointCloud2";
  for (const std::string& image : images) message += (&image == &images[0] ? "; of the images " : ", ") + image;
  if (!images.empty()) message += " depth_image_proc can make clouds where one of them is a depth image";
  remarks.push_back({Severity::error, "clouds", message});
}

}  // namespace

std::vector<std::string> BagReport::usableTopics() const {
  std::vector<std::string> topics;
  for (const CloudCheck& cloud : clouds) {
    if (cloud.usable() > 0) topics.push_back(cloud.topic());
  }
  return topics;
}

BagReport inspectBag(const BagFile& bag, const Progress& progress) {
  BagReport report;
  std::tie(report.begin, report.end) = bag.timeRange();
  std::set<ros::Time> cloud_stamps;
  for (const BagTopic& topic : bag.topics()) {
    if (topic.type == "sensor_msgs/PointCloud2") {
      report.clouds.push_back(checkClouds(bag, topic, progress));
      const std::vector<ros::Time>& stamps = report.clouds.back().stamps().stamps();
      cloud_stamps.insert(stamps.begin(), stamps.end());
    } else if (topic.type == "sensor_msgs/CameraInfo") {
      report.cameras.push_back(checkCamera(bag, topic.name));
    } else if (topic.type == "tf2_msgs/TFMessage") {
      const bool is_static = topic.name == "/tf_static";
      bag.forEach<tf2_msgs::TFMessage>(
          topic.name, [&](const auto& message, const ros::Time&) { report.transforms.add(message, is_static); });
    }
  }
  for (const std::string& topic : bag.topicsOf("sks_detector/DetectionArray")) {
    report.detections.push_back(checkDetections(bag, topic, cloud_stamps));
  }

  remarkOnWhatIsMissing(bag, report.remarks);
  for (const CloudCheck& cloud : report.clouds) {
    cloud.remark(report.remarks);
    if (cloud.frames().size() != 1) continue;
    report.transforms.remarkOn(cloud.topic(), *cloud.frames().begin(), cloud.stamps().stamps(), report.remarks);
  }
  report.transforms.remark(report.remarks);
  for (const CameraInfoReport& camera : report.cameras) remarkOnCamera(camera, report.clouds, report.remarks);
  if (!report.clouds.empty()) {
    for (const DetectionsReport& detections : report.detections) remarkOnDetections(detections, report.remarks);
  }
  std::stable_sort(report.remarks.begin(), report.remarks.end(),
                   [](const Remark& a, const Remark& b) { return a.severity > b.severity; });
  return report;
}

}  // namespace sks::tools
