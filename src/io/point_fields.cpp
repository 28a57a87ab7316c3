// SPDX-License-Identifier: BSD-3-Clause
#include "io/point_fields.hpp"

#include <algorithm>
#include <cstring>

#include <sks_detector/error.hpp>

namespace sks {
namespace {

[[noreturn]] void badFields(const std::string& message) {
  throw Error(ErrorCode::bad_data, message);
}

const PointField* find(const PointBlock& block, const std::string& name) {
  const auto found = std::find_if(block.fields.begin(), block.fields.end(),
                                  [&](const PointField& field) { return field.name == name; });
  return found == block.fields.end() ? nullptr : &*found;
}

std::string fieldNames(const PointBlock& block) {
  std::string names;
  for (const PointField& field : block.fields) names += (names.empty() ? "" : ", ") + field.name;
  return names.empty() ? "none" : names;
}

void checkInside(const PointBlock& block, const PointField& field, std::size_t bytes) {
  if (field.offset > block.point_step || block.point_step - field.offset < bytes) {
    badFields("field '" + field.name + "' lies outside the " + std::to_string(block.point_step) + " bytes of a point");
  }
}

void checkLengths(const PointBlock& block) {
  const std::uint64_t row = std::uint64_t(block.width) * block.point_step;
  const std::uint64_t needed = block.height == 0 ? 0 : (block.height - 1) * std::uint64_t(block.row_step) + row;
  if (block.point_step == 0 || (block.height > 1 && block.row_step < row) || needed > block.size) {
    badFields("it says " + std::to_string(block.width) + " x " + std::to_string(block.height) + " points of " +
         std::to_string(block.point_step) + " bytes, but holds " + std::to_string(block.size) + " bytes");
  }
}

template <typename T>
T load(const std::uint8_t* from, bool swapped) {
  std::uint8_t bytes[sizeof(T)];
  std::memcpy(bytes, from, sizeof(T));
  if (swapped) std::reverse(bytes, bytes + sizeof(T));
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

bool hostIsBigEndian() {
  const std::uint16_t one = 1;
  std::uint8_t first = 0;
  std::memcpy(&first, &one, 1);
  return first == 0;
}

/// Calls `f(pointer to the point, its index)` row by row.
template <typename Function>
void forEachPoint(const PointBlock& block, Function f) {
  if (block.width == 0) return;  // however many rows of nothing there are
  std::size_t index = 0;
  for (std::size_t row = 0; row < block.height; ++row) {
    const std::uint8_t* point = block.data + row * block.row_step;
    for (std::size_t column = 0; column < block.width; ++column, point += block.point_step) f(point, index++);
  }
}

template <typename T>
void readAxis(const PointBlock& block, const PointField& field, int axis, double scale, Cloud& cloud) {
  checkInside(block, field, sizeof(T));
  const bool swapped = block.big_endian != hostIsBigEndian();
  forEachPoint(block, [&](const std::uint8_t* point, std::size_t i) {
    cloud.points[i][axis] = float(scale * double(load<T>(point + field.offset, swapped)));
  });
}

}  // namespace

Cloud toCloud(const PointBlock& block, double scale) {
  checkLengths(block);
  Cloud cloud;
  cloud.width = block.width;
  cloud.height = block.height;
  cloud.points.resize(std::size_t(block.width) * block.height);
  const char* const axes[] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) {
    const PointField* field = find(block, axes[axis]);
    if (!field) badFields(std::string("there is no field '") + axes[axis] + "'; its fields are " + fieldNames(block));
    if (field->type == PointField::float32) {
      readAxis<float>(block, *field, axis, scale, cloud);
    } else if (field->type == PointField::float64) {
      readAxis<double>(block, *field, axis, scale, cloud);
    } else {
      badFields(std::string("field '") + axes[axis] + "' holds integers; coordinates must be float or double");
    }
  }
  const PointField* color = find(block, "rgb");
  if (!color) color = find(block, "rgba");
  if (!color) return cloud;
  if (color->type < PointField::int32 || color->type > PointField::float32) {
    badFields("field '" + color->name + "' must pack a colour into four bytes (float or uint32)");
  }
  checkInside(block, *color, 4);
  cloud.colors.resize(cloud.points.size());
  const bool swapped = block.big_endian != hostIsBigEndian();
  forEachPoint(block, [&](const std::uint8_t* point, std::size_t i) {
    const auto packed = load<std::uint32_t>(point + color->offset, swapped);
    cloud.colors[i] = {std::uint8_t(packed >> 16), std::uint8_t(packed >> 8), std::uint8_t(packed)};
  });
  return cloud;
}

}  // namespace sks
