// SPDX-License-Identifier: BSD-3-Clause
#include "io/point_fields.hpp"

#include <algorithm>
#include <cstring>
#include <iterator>

#include <sks_detector/error.hpp>

#include "core/settings/shown_text.hpp"
#include "io/point_colors.hpp"

namespace sks {
namespace {

[[noreturn]] void badFields(const std::string& message) {
  throw Error(ErrorCode::bad_data, message);
}

std::vector<std::string> namesOf(const PointBlock& block) {
  std::vector<std::string> names;
  for (const PointField& field : block.fields) names.push_back(field.name);
  return names;
}

void checkInside(const PointBlock& block, const PointField& field, std::size_t bytes) {
  if (field.offset > block.point_step || block.point_step - field.offset < bytes) {
    badFields("field '" + shown(field.name) + "' lies outside the " + std::to_string(block.point_step) +
              " bytes of a point");
  }
}

void checkLengths(const PointBlock& block) {
  const std::uint64_t row = std::uint64_t(block.width) * block.point_step;
  const std::uint64_t needed = block.height == 0 ? 0 : (block.height - 1) * std::uint64_t(block.row_step) + row;
  if (block.point_step == 0 || (block.height > 1 && block.row_step < row) || needed > block.size) {
    badFields("it says " + std::to_string(block.width) + " x " + std::to_string(block.height) + " points of " +
              std::to_string(block.point_step) + " bytes in rows of " + std::to_string(block.row_step) +
              " bytes, but holds " + std::to_string(block.size) + " bytes");
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

/// Calls `f(value, index)` for the value of a field at each point.
template <typename T, typename Function>
void forEachValue(const PointBlock& block, const PointField& field, Function&& f) {
  checkInside(block, field, sizeof(T));
  const bool swapped = block.big_endian != hostIsBigEndian();
  forEachPoint(block, [&](const std::uint8_t* point, std::size_t i) { f(load<T>(point + field.offset, swapped), i); });
}

void readAxis(const PointBlock& block, const PointField& field, int axis, double scale, Cloud& cloud) {
  const auto store = [&](auto value, std::size_t i) { cloud.points[i][axis] = float(scale * double(value)); };
  if (field.type == PointField::float32) return forEachValue<float>(block, field, store);
  if (field.type == PointField::float64) return forEachValue<double>(block, field, store);
  badFields("field '" + field.name + "' holds integers; coordinates must be float or double");
}

void readChannel(const PointBlock& block, const PointField& field, int channel,
                 std::vector<Eigen::Vector3f>& channels) {
  const auto store = [&](auto value, std::size_t i) { channels[i][channel] = float(value); };
  switch (field.type) {
    case PointField::int8:
      return forEachValue<std::int8_t>(block, field, store);
    case PointField::uint8:
      return forEachValue<std::uint8_t>(block, field, store);
    case PointField::int16:
      return forEachValue<std::int16_t>(block, field, store);
    case PointField::uint16:
      return forEachValue<std::uint16_t>(block, field, store);
    case PointField::int32:
      return forEachValue<std::int32_t>(block, field, store);
    case PointField::uint32:
      return forEachValue<std::uint32_t>(block, field, store);
    case PointField::float32:
      return forEachValue<float>(block, field, store);
    case PointField::float64:
      return forEachValue<double>(block, field, store);
    default:
      badFields("field '" + shown(field.name) + "' has the unknown type " + std::to_string(field.type));
  }
}

/// Three fields of one value each, or one of three and more: `rgb` with COUNT 3.
std::vector<PointField> channelFields(const PointBlock& block) {
  const auto names = namesOf(block);
  std::vector<PointField> channels;
  if (const auto packed = packedColorField(names)) {
    const PointField& field = block.fields[*packed];
    for (std::uint32_t i = 0; field.count >= 3 && i < 3; ++i) {
      channels.push_back({field.name, field.offset + i * std::uint32_t(sizeOfType(field.type)), field.type});
    }
  } else if (const auto indices = colorChannelFields(names)) {
    for (const std::size_t i : *indices) channels.push_back(block.fields[i]);
  }
  return channels;
}

void readColors(const PointBlock& block, Cloud& cloud) {
  const std::vector<PointField> channels = channelFields(block);
  if (!channels.empty()) {
    std::vector<Eigen::Vector3f> values(cloud.points.size());
    for (int i = 0; i < 3; ++i) readChannel(block, channels[std::size_t(i)], i, values);
    cloud.colors = colorsOfChannels(values, {channels[0].type, channels[1].type, channels[2].type});
    return;
  }
  const auto packed = packedColorField(namesOf(block));
  if (!packed) return;
  const PointField& field = block.fields[*packed];
  if (field.type < PointField::int32 || field.type > PointField::float32) {
    badFields("field '" + field.name + "' must pack a colour into four bytes (float or uint32)");
  }
  cloud.colors.resize(cloud.points.size());
  forEachValue<std::uint32_t>(block, field,
                              [&](std::uint32_t value, std::size_t i) { cloud.colors[i] = unpackedColor(value); });
}

}  // namespace

std::size_t sizeOfType(std::uint8_t type) {
  constexpr std::size_t sizes[] = {0, 1, 1, 2, 2, 4, 4, 4, 8};
  return type < std::size(sizes) ? sizes[type] : 0;
}

Cloud toCloud(const PointBlock& block, double scale) {
  checkLengths(block);
  Cloud cloud;
  cloud.width = block.width;
  cloud.height = block.height;
  cloud.points.resize(std::size_t(block.width) * block.height);
  const char* const axes[] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) {
    const auto field = std::find_if(block.fields.begin(), block.fields.end(),
                                    [&](const PointField& other) { return other.name == axes[axis]; });
    if (field == block.fields.end()) {
      badFields(std::string("there is no field '") + axes[axis] + "'; its fields are " +
                (block.fields.empty() ? "none" : shownList(namesOf(block))));
    }
    readAxis(block, *field, axis, scale, cloud);
  }
  readColors(block, cloud);
  return cloud;
}

}  // namespace sks
