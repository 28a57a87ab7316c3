// SPDX-License-Identifier: BSD-3-Clause
// PLY files are read here and not by PCL, whose reader ends the process on some files that are damaged or unusual.
#pragma once

#include <cstdint>
#include <istream>
#include <string>
#include <vector>

#include <sks_detector/cloud.hpp>

#include "io/point_fields.hpp"

namespace sks {

struct PlyProperty {
  std::string name;
  PointField::Type type = PointField::float32;  ///< of the value, or of the values of a list
  bool list = false;
  PointField::Type count_type = PointField::uint8;  ///< of a list's length
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

enum class PlyFormat { ascii, binary_little_endian, binary_big_endian };

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::vector<std::string> textures;  ///< names of the pictures, of the comments "TextureFile"
};

/// Reads and checks all lines up to end_header. @throws Error(bad_data)
PlyHeader readPlyHeader(std::istream& file);

/// The vertices with their colour (red, green, blue as uchar); the sensor origin from the element "camera", which PCL
/// writes. @throws Error(bad_data)
Cloud readPly(std::istream& file, std::uint64_t file_size, double scale);

}  // namespace sks
