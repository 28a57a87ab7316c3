// SPDX-License-Identifier: BSD-3-Clause
// PCD files are read here and not by PCL, whose reader crashes on damaged headers.
#pragma once

#include <cstdint>
#include <istream>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <sks_detector/cloud.hpp>

namespace sks {

struct PcdField {
  std::string name;
  char type = 'F';          ///< 'F', 'I' or 'U'
  std::uint32_t size = 4;   ///< bytes of a value
  std::uint32_t count = 1;  ///< values
};

enum class PcdData { ascii, binary, compressed };

struct PcdHeader {
  std::vector<PcdField> fields;
  std::uint32_t width = 0;
  std::uint32_t height = 1;
  Eigen::Vector3d viewpoint = Eigen::Vector3d::Zero();
  PcdData data = PcdData::ascii;

  std::uint64_t points() const { return std::uint64_t(width) * height; }
  std::uint64_t valuesOfPoint() const;
  std::uint64_t bytesOfPoint() const;
};

/// Reads and checks all lines up to DATA. @throws Error(bad_data)
PcdHeader readPcdHeader(std::istream& file);

/// The points as they lie in memory, bytesOfPoint() each. @throws Error(bad_data)
std::vector<std::uint8_t> readPcdData(std::istream& file, const PcdHeader& header, std::uint64_t file_size);

/// @throws Error(bad_data)
Cloud readPcd(std::istream& file, std::uint64_t file_size, double scale);

}  // namespace sks
