// SPDX-License-Identifier: BSD-3-Clause
#include "ros/cloud_message.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#include <sks_detector/error.hpp>

#include "io/point_fields.hpp"

namespace sks_detector {
namespace {

using MessageField = sensor_msgs::PointField;

std::vector<sks::PointField> fieldsOf(const sensor_msgs::PointCloud2& message) {
  std::vector<sks::PointField> fields;
  for (const MessageField& field : message.fields) {
    fields.push_back({field.name, field.offset, field.datatype, field.count});
  }
  return fields;
}

/// Bytes from row to row. Where the points fill the data, nothing else is asked: `row_step` is often wrong, and no
/// other program minds. Else rows may be longer than their points; what follows the last point may be missing.
std::size_t rowStepOf(const sensor_msgs::PointCloud2& message) {
  const std::uint64_t points = std::uint64_t(message.width) * message.height, size = message.data.size();
  const std::uint64_t row = std::uint64_t(message.width) * message.point_step, step = message.row_step;
  const auto times = [](std::uint64_t a, std::uint64_t b) {  // any too large number where it does not fit
    return a != 0 && b > std::numeric_limits<std::uint64_t>::max() / a ? std::numeric_limits<std::uint64_t>::max()
                                                                       : a * b;
  };
  if (message.point_step == 0) {
    throw sks::Error(sks::ErrorCode::bad_data, "its point_step is 0; set it to the bytes of a point");
  }
  if (times(points, message.point_step) == size) return row;
  const std::uint64_t rows = times(step, message.height);
  if (step >= row && (rows == size || rows - (step - row) == size)) return step;
  throw sks::Error(sks::ErrorCode::bad_data,
                   "it says " + std::to_string(message.width) + " x " + std::to_string(message.height) + " points of " +
                       std::to_string(message.point_step) + " bytes (" +
                       std::to_string(times(points, message.point_step)) + " bytes in all) in rows of " +
                       std::to_string(step) + " bytes (" + std::to_string(rows) + " bytes), but holds " +
                       std::to_string(size) + " bytes, which is neither" +
                       (step < row ? ", and its rows are shorter than their points" : ""));
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
  if (message.width == 0 || message.height == 0) {
    throw sks::Error(sks::ErrorCode::bad_data, "the cloud is empty (0 points)");
  }
  sks::PointBlock block;
  block.width = message.width;
  block.height = message.height;
  block.point_step = message.point_step;
  block.row_step = rowStepOf(message);
  block.fields = fieldsOf(message);
  block.data = message.data.data();
  block.size = message.data.size();
  return sks::toCloud(block);
}

sks::Cloud receivedCloud(const sensor_msgs::PointCloud2& message, int max_points) {
  const std::uint64_t points = std::uint64_t(message.width) * message.height;
  if (points > std::uint64_t(max_points)) {  // neighbourhoods in a dense cloud cost the square of its size
    throw sks::Error(sks::ErrorCode::bad_data, "it has " + std::to_string(points) +
                                                   " points, more than ~max_points = " + std::to_string(max_points) +
                                                   ": thin it, by pcl/VoxelGrid for example, or set ~max_points");
  }
  return toCloud(message);
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
