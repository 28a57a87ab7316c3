// SPDX-License-Identifier: BSD-3-Clause
// The values of PLY files, for clouds and meshes alike.
#pragma once

#include <array>
#include <cstdint>
#include <istream>
#include <limits>
#include <string>
#include <vector>

#include "io/ply_file.hpp"

namespace sks {

/// One instance of an element.
struct PlyInstance {
  std::vector<double> values;              ///< of each property; 0 of a list
  std::vector<std::vector<double>> lists;  ///< of each property; empty of a number
};

/// Reads value by value; all types of PLY fit into a double.
class PlyValues {
public:
  PlyValues(std::istream& file, PlyFormat format) : file_(file), format_(format) {}

  /// @throws Error(bad_data) where the file ends or holds no number
  double next(PointField::Type type);
  /// Reads the next instance. @throws Error(bad_data)
  void read(const PlyElement& element, PlyInstance& instance);
  /// Reads over instances. @throws Error(bad_data)
  void skip(const PlyElement& element);

private:
  template <typename T>
  double number();
  double word();

  std::istream& file_;
  PlyFormat format_;
  std::string word_;
};

/// Compares the counts of a header with the bytes that are left. @throws Error(bad_data)
void checkElement(const PlyElement& element, PlyFormat format, std::uint64_t bytes_left);

constexpr std::size_t ply_absent = std::numeric_limits<std::size_t>::max();

/// Names of the properties; of lists empty.
std::vector<std::string> plyValueNames(const PlyElement& element);

/// Place of a number, or of a list, among the properties; ply_absent where it is not there.
std::size_t plyIndex(const PlyElement& element, const std::string& name, bool list = false);

template <std::size_t count>
std::array<std::size_t, count> plyIndices(const PlyElement& element, const std::array<const char*, count>& names) {
  std::array<std::size_t, count> indices;
  for (std::size_t i = 0; i < count; ++i) indices[i] = plyIndex(element, names[i]);
  return indices;
}

template <std::size_t count>
bool plyComplete(const std::array<std::size_t, count>& indices) {
  for (const std::size_t index : indices) {
    if (index == ply_absent) return false;
  }
  return true;
}

}  // namespace sks
