// SPDX-License-Identifier: BSD-3-Clause
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>

#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/distortion_models.h>
#include <sks_detector/DetectionArray.h>
#include <tf2_msgs/TFMessage.h>

#include <sks_detector/error.hpp>

#include "io/atomic_file.hpp"
#include "ros/cloud_message.hpp"
#include "ros/detection_message.hpp"
#include "tools/bag.hpp"

namespace sks::tools {
namespace {

constexpr char camera_frame[] = "camera_rgb_optical_frame";
constexpr char table_frame[] = "table";
constexpr std::uint32_t first_second = 1500000000;  // a time like any other, and the same in every recording

sensor_msgs::CameraInfo cameraInfo(const CameraModel& camera) {
  sensor_msgs::CameraInfo info;
  info.width = std::uint32_t(camera.width);
  info.height = std::uint32_t(camera.height);
  info.distortion_model = sensor_msgs::distortion_models::PLUMB_BOB;
  info.D.assign(5, 0.0);
  info.K = {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
  info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.P = {camera.fx, 0, camera.cx, 0, 0, camera.fy, camera.cy, 0, 0, 0, 1, 0};
  return info;
}

tf2_msgs::TFMessage transformMessage(const Eigen::Isometry3d& T_table_camera, const ros::Time& stamp) {
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = stamp;
  transform.header.frame_id = table_frame;
  transform.child_frame_id = camera_frame;
  const Eigen::Quaterniond rotation(T_table_camera.linear());
  transform.transform.translation.x = T_table_camera.translation().x();
  transform.transform.translation.y = T_table_camera.translation().y();
  transform.transform.translation.z = T_table_camera.translation().z();
  transform.transform.rotation.x = rotation.x();
  transform.transform.rotation.y = rotation.y();
  transform.transform.rotation.z = rotation.z();
  transform.transform.rotation.w = rotation.w();
  tf2_msgs::TFMessage message;
  message.transforms.push_back(transform);
  return message;
}

sks_detector::DetectionArray truthMessage(const std::vector<Detection>& truth, const std_msgs::Header& header) {
  sks_detector::DetectionArray message;
  message.header = header;
  for (const Detection& object : truth) message.detections.push_back(sks_detector::toMessage(object));
  return message;
}

}  // namespace

struct BagRecorder::Impl {
  std::string path;
  std::string unfinished;  // where it is written to; empty once it has its name
  double rate;
  std::uint32_t frames = 0;
  sensor_msgs::CameraInfo info;
  rosbag::Bag bag;

  /// Runs what writes, with rosbag's complaints in the core's words.
  template <typename Function>
  void write(Function function) {
    try {
      function();
    } catch (const rosbag::BagException& error) {
      throw Error(ErrorCode::bad_file, "cannot write '" + path + "': " + error.what());
    }
  }
};

BagRecorder::BagRecorder(const std::string& path, const CameraModel& camera, double rate) : impl_(new Impl) {
  if (!(rate >= 0.001 && rate <= 1000)) {
    throw Error(ErrorCode::bad_usage, "the rate of a bag, " + std::to_string(rate) + ", must be in [0.001, 1000] Hz");
  }
  impl_->path = path;
  impl_->rate = rate;
  impl_->info = cameraInfo(camera);
  const std::string unfinished = temporaryName(path, ".active");
  impl_->write([&] { impl_->bag.open(unfinished, rosbag::bagmode::Write); });
  impl_->unfinished = unfinished;
}

BagRecorder::~BagRecorder() {
  if (impl_->unfinished.empty()) return;
  try {
    impl_->bag.close();
  } catch (const std::exception&) {  // what could not be written is removed anyway
  }
  std::remove(impl_->unfinished.c_str());
}

void BagRecorder::add(const Cloud& cloud, const Eigen::Isometry3d& T_table_camera,
                      const std::vector<Detection>& truth) {
  Impl& to = *impl_;
  std_msgs::Header header;
  header.frame_id = camera_frame;
  header.stamp = ros::Time(first_second, 0) + ros::Duration().fromNSec(std::llround(1e9 * to.frames / to.rate));
  ++to.frames;
  to.info.header = header;
  to.write([&] {
    to.bag.write("/tf", header.stamp, transformMessage(T_table_camera, header.stamp));
    to.bag.write("/camera/rgb/camera_info", header.stamp, to.info);
    to.bag.write("/ground_truth", header.stamp, truthMessage(truth, header));
    to.bag.write("/camera/depth_registered/points", header.stamp, sks_detector::toMessage(cloud, header));
  });
}

void BagRecorder::finish() {
  impl_->write([&] { impl_->bag.close(); });
  if (std::rename(impl_->unfinished.c_str(), impl_->path.c_str()) != 0) {
    throw Error(ErrorCode::bad_file, "cannot write '" + impl_->path + "': " + std::strerror(errno));
  }
  impl_->unfinished.clear();
}

}  // namespace sks::tools
