// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <sks_detector/cloud.hpp>

namespace sks {

/// One field of points that lie in raw memory; the types' numbers are those of PCL and of sensor_msgs/PointField.
struct PointField {
  enum Type : std::uint8_t { int8 = 1, uint8, int16, uint16, int32, uint32, float32, float64 };

  std::string name;
  std::uint32_t offset = 0;  ///< from the point's first byte
  std::uint8_t type = 0;
  std::uint32_t count = 1;  ///< values; 0 counts as 1
};

/// Bytes of one value of a type; 0 for one that is unknown.
std::size_t sizeOfType(std::uint8_t type);

/// Points in raw memory, as PCLPointCloud2 and sensor_msgs/PointCloud2 hold them.
struct PointBlock {
  std::uint32_t width = 0;
  std::uint32_t height = 1;
  std::size_t point_step = 0;  ///< bytes from point to point
  std::size_t row_step = 0;    ///< bytes from row to row
  bool big_endian = false;
  std::vector<PointField> fields;
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;  ///< bytes at `data`
};

/// Positions (float or double x, y, z) and colour as point_colors.hpp has it, each checked to lie within the data
/// before it is read.
/// @param scale factor to metres
/// @throws Error(bad_data) saying what is wrong with the fields or lengths
Cloud toCloud(const PointBlock& block, double scale = 1.0);

}  // namespace sks
