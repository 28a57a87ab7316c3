// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>

#include <sensor_msgs/PointCloud2.h>

namespace sks::fuzz {

/// Names of fields, by which an input's byte picks one.
constexpr std::array<const char*, 8> field_names = {"x", "y", "z", "rgb", "rgba", "intensity", "label", ""};

/// Takes an input apart, number by number; zeros follow its end.
class InputReader {
public:
  InputReader(const std::uint8_t* data, std::size_t size) : next_(data), left_(size) {}

  template <typename Integer>
  Integer take() {
    Integer value = 0;
    if (left_ >= sizeof(value)) std::memcpy(&value, next_, sizeof(value));
    const std::size_t taken = left_ < sizeof(value) ? left_ : sizeof(value);
    next_ += taken;
    left_ -= taken;
    return value;
  }
  std::vector<std::uint8_t> rest() const { return {next_, next_ + left_}; }

private:
  const std::uint8_t* next_;
  std::size_t left_;
};

/// A message whose every member may be wrong.
inline sensor_msgs::PointCloud2 messageOf(const std::uint8_t* data, std::size_t size) {
  InputReader input(data, size);
  sensor_msgs::PointCloud2 message;
  const auto flags = input.take<std::uint8_t>();
  message.is_bigendian = flags == 255;
  message.is_dense = flags & 1;
  message.width = input.take<std::uint32_t>();
  message.height = input.take<std::uint32_t>();
  message.point_step = input.take<std::uint32_t>();
  message.row_step = input.take<std::uint32_t>();
  message.fields.resize(input.take<std::uint8_t>() % 8);
  for (sensor_msgs::PointField& field : message.fields) {
    field.name = field_names[input.take<std::uint8_t>() % field_names.size()];
    field.datatype = input.take<std::uint8_t>();
    field.offset = input.take<std::uint32_t>();
    field.count = 1;
  }
  message.data = input.rest();
  return message;
}

/// The input that messageOf() turns into a message.
inline std::string inputOf(const sensor_msgs::PointCloud2& message) {
  std::string input;
  const auto append = [&](auto value) { input.append(reinterpret_cast<const char*>(&value), sizeof(value)); };
  append(message.is_dense);
  append(message.width);
  append(message.height);
  append(message.point_step);
  append(message.row_step);
  append(std::uint8_t(message.fields.size()));
  for (const sensor_msgs::PointField& field : message.fields) {
    std::uint8_t name = 0;
    while (field.name != field_names[name]) ++name;
    append(name);
    append(field.datatype);
    append(field.offset);
  }
  return input.append(message.data.begin(), message.data.end());
}

}  // namespace sks::fuzz
