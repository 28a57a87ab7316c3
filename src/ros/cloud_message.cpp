// SPDX-License-Identifier: BSD-3-Clause
#include "ros/cloud_message.hpp"

#include <algorithm>
#include <cstring>

#include <sks_detector/error.hpp>

#include "io/point_fields.hpp"

namespace sks_detector {
namespace {

using MessageField = sensor_msgs::PointField;

std::vector<sks::PointField> fieldsOf(const sensor_msgs::PointCloud2& message) {
  std::vector<sks::PointField> fields;
  for (const MessageField& field : message.fields) fields.push_back({field.name, field.offset, field.datatype});
  return fields;
}

void addField(sensor_msgs::PointCloud2& message, const std::string& name) {
  MessageField field;
  field.name = name;
  field.offset = message.point_step;
  field.datatype = MessageField::FLOAT32;  // also of rgb, whose four bytes stand in a float by convention
  field.count = 1;
  message.fields.push_back(field);
  message.point_step += sizeof(float);
}

}  // namespace

sks::Cloud toCloud(const sensor_msgs::PointCloud2& message) {
  if (message.is_bigendian) {
    throw sks::Error(sks::ErrorCode::bad_data, "the cloud is big-endian; publish it with is_bigendian = false");
  }
  const std::uint64_t points = std::uint64_t(message.width) * message.height, size = message.data.size();
  if (points * message.point_step != size && std::uint64_t(message.row_step) * message.height != size) {
    throw sks::Error(sks::ErrorCode::bad_data, "it says " + std::to_string(message.width) + " x " +
                                                   std::to_string(message.height) + " points of " +
                                                   std::to_string(message.point_step) + " bytes, but holds " +
                                                   std::to_string(size) + " bytes");
  }
  if (points == 0) throw sks::Error(sks::ErrorCode::bad_data, "the cloud is empty (0 points)");
  sks::PointBlock block;
  block.width = message.width;
  block.height = message.height;
  block.point_step = message.point_step;
  block.row_step = message.row_step;
  block.fields = fieldsOf(message);
  block.data = message.data.data();
  block.size = message.data.size();
  return sks::toCloud(block);
}

sensor_msgs::PointCloud2 toMessage(const sks::Cloud& cloud, const std_msgs::Header& header) {
  sensor_msgs::PointCloud2 message;
  message.header = header;
  message.width = cloud.columnCount();
  message.height = cloud.rowCount();
  for (const char* axis : {"x", "y", "z"}) addField(message, axis);
  if (cloud.hasColor()) addField(message, "rgb");
  message.row_step = message.point_step * message.width;
  message.is_dense = std::all_of(cloud.points.begin(), cloud.points.end(),
                                 [](const Eigen::Vector3f& point) { return point.allFinite(); });
  message.data.resize(cloud.size() * message.point_step);
  std::uint8_t* to = message.data.data();
  for (std::size_t i = 0; i < cloud.size(); ++i, to += message.point_step) {
    std::memcpy(to, cloud.points[i].data(), 3 * sizeof(float));
    if (!cloud.hasColor()) continue;
    const sks::Rgb& color = cloud.colors[i];
    const std::uint32_t packed = std::uint32_t(color.r) << 16 | std::uint32_t(color.g) << 8 | color.b;
    std::memcpy(to + 3 * sizeof(float), &packed, sizeof(packed));
  }
  return message;
}

}  // namespace sks_detector
