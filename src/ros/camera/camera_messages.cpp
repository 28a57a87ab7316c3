// SPDX-License-Identifier: BSD-3-Clause
#include "ros/camera/camera_messages.hpp"

#include <cstddef>

#include <sensor_msgs/distortion_models.h>
#include <sensor_msgs/image_encodings.h>
#include <boost/make_shared.hpp>

#include "ros/camera/organized_cloud.hpp"

namespace sks_detector {
namespace {

sensor_msgs::PointField floatField(const char* name, std::uint32_t offset) {
  sensor_msgs::PointField field;
  field.name = name;
  field.offset = offset;
  field.datatype = sensor_msgs::PointField::FLOAT32;
  field.count = 1;
  return field;
}

template <typename Value>
void copyBytes(const std::vector<Value>& from, std::vector<std::uint8_t>& to) {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(from.data());
  to.assign(bytes, bytes + from.size() * sizeof(Value));
}

template <typename Image>
sensor_msgs::ImagePtr imageMessage(const Image& image, const char* encoding, std::uint32_t pixel_size,
                                   const std_msgs::Header& header) {
  auto message = boost::make_shared<sensor_msgs::Image>();
  message->header = header;
  message->width = std::uint32_t(image.width);
  message->height = std::uint32_t(image.height);
  message->encoding = encoding;
  message->step = message->width * pixel_size;
  copyBytes(image.pixels, message->data);
  return message;
}

}  // namespace

sensor_msgs::PointCloud2Ptr cloudMessage(const CameraFrame& frame, const std_msgs::Header& header) {
  auto message = boost::make_shared<sensor_msgs::PointCloud2>();
  message->header = header;
  message->width = std::uint32_t(frame.depth.width);
  message->height = std::uint32_t(frame.depth.height);
  message->fields = {floatField("x", 0), floatField("y", 4), floatField("z", 8)};
  if (!frame.color.pixels.empty()) message->fields.push_back(floatField("rgb", 12));
  message->point_step = sizeof(OrganizedPoint);
  message->row_step = message->width * message->point_step;
  message->is_dense = 0;
  message->data.resize(std::size_t(message->row_step) * message->height);
  organizedCloud(frame, reinterpret_cast<OrganizedPoint*>(message->data.data()));  // 5 MB are not copied once more
  return message;
}

sensor_msgs::ImagePtr depthMessage(const DepthImage& image, const std_msgs::Header& header) {
  return imageMessage(image, sensor_msgs::image_encodings::TYPE_16UC1.c_str(), 2, header);
}

sensor_msgs::ImagePtr colorMessage(const ColorImage& image, const std_msgs::Header& header) {
  return imageMessage(image, sensor_msgs::image_encodings::RGB8.c_str(), 3, header);
}

sensor_msgs::CameraInfoPtr cameraInfoMessage(const CameraFrame& frame, const std_msgs::Header& header) {
  auto message = boost::make_shared<sensor_msgs::CameraInfo>();
  const Intrinsics& k = frame.intrinsics;
  message->header = header;
  message->width = std::uint32_t(frame.depth.width);
  message->height = std::uint32_t(frame.depth.height);
  message->distortion_model = sensor_msgs::distortion_models::PLUMB_BOB;
  message->D.assign(5, 0.0);
  message->K = {k.fx, 0, k.cx, 0, k.fy, k.cy, 0, 0, 1};
  message->R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  message->P = {k.fx, 0, k.cx, 0, 0, k.fy, k.cy, 0, 0, 0, 1, 0};
  return message;
}

}  // namespace sks_detector
