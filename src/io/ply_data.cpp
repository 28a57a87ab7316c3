// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <sks_detector/error.hpp>

#include "io/ply_values.hpp"
#include "io/point_colors.hpp"

namespace sks {
namespace {

[[noreturn]] void badPly(const std::string& message) {
  throw Error(ErrorCode::bad_data, message);
}

std::array<std::size_t, 3> coordinates(const PlyElement& vertices) {
  const std::array<const char*, 3> names = {"x", "y", "z"};
  const auto indices = plyIndices(vertices, names);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string name = std::string("property '") + names[i] + "'";
    if (indices[i] == ply_absent) badPly("its vertices have no " + name);
    const PointField::Type type = vertices.properties[indices[i]].type;
    if (type != PointField::float32 && type != PointField::float64) {
      badPly(name + " of its vertices holds integers; coordinates must be float or double");
    }
  }
  return indices;
}

/// The colours of vertices, value by value.
class VertexColors {
public:
  explicit VertexColors(const PlyElement& vertices)
      : packed_(packedColorField(plyValueNames(vertices))), places_(colorChannelFields(plyValueNames(vertices))) {
    if (packed_ && vertices.properties[*packed_].type < PointField::int32) packed_.reset();  // no room for three bytes
    if (packed_) as_float_ = vertices.properties[*packed_].type == PointField::float32;
    for (std::size_t i = 0; places_ && i < 3; ++i) types_[i] = vertices.properties[(*places_)[i]].type;
  }

  void add(const std::vector<double>& row) {
    if (packed_) {
      colors_.push_back(unpackedColor(bitsOf(row[*packed_])));
    } else if (places_) {
      channels_.emplace_back(float(row[(*places_)[0]]), float(row[(*places_)[1]]), float(row[(*places_)[2]]));
    }
  }

  std::vector<Rgb> take() { return packed_ ? std::move(colors_) : colorsOfChannels(channels_, types_); }

private:
  std::uint32_t bitsOf(double value) const {
    if (!as_float_) return std::abs(value) < 4294967296.0 ? std::uint32_t(std::int64_t(value)) : 0;
    const auto narrow = float(value);
    std::uint32_t bits = 0;
    std::memcpy(&bits, &narrow, sizeof(bits));
    return bits;
  }

  std::optional<std::size_t> packed_;
  std::optional<std::array<std::size_t, 3>> places_;
  std::array<std::uint8_t, 3> types_{};
  bool as_float_ = false;
  std::vector<Eigen::Vector3f> channels_;
  std::vector<Rgb> colors_;
};

void readVertices(PlyValues& values, const PlyElement& element, double scale, Cloud& cloud) {
  const auto axes = coordinates(element);
  VertexColors colors(element);
  cloud.width = std::uint32_t(element.count);
  cloud.points.reserve(element.count);
  PlyInstance instance;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    values.read(element, instance);
    const std::vector<double>& row = instance.values;
    cloud.points.emplace_back(float(scale * row[axes[0]]), float(scale * row[axes[1]]), float(scale * row[axes[2]]));
    colors.add(row);
  }
  cloud.colors = colors.take();
}

void readCamera(PlyValues& values, const PlyElement& element, double scale, Cloud& cloud) {
  const auto origin = plyIndices<3>(element, {"view_px", "view_py", "view_pz"});
  PlyInstance instance;
  values.read(element, instance);
  if (!plyComplete(origin)) return;
  for (int axis = 0; axis < 3; ++axis)
    cloud.sensor_origin[axis] = float(scale * instance.values[origin[std::size_t(axis)]]);
}

}  // namespace

Cloud readPly(std::istream& file, std::uint64_t file_size, double scale) {
  const PlyHeader header = readPlyHeader(file);
  const std::uint64_t there = file_size - std::uint64_t(file.tellg());
  PlyValues values(file, header.format);
  Cloud cloud;
  bool has_vertices = false;
  for (const PlyElement& element : header.elements) {
    if (element.count == 0 && element.name != "vertex") continue;
    checkElement(element, header.format, there);
    if (element.name == "vertex" && !has_vertices) {
      has_vertices = true;
      readVertices(values, element, scale, cloud);
    } else if (element.name == "camera") {
      readCamera(values, element, scale, cloud);
    } else {
      values.skip(element);
    }
  }
  if (!has_vertices) badPly("its PLY header has no element vertex");
  return cloud;
}

}  // namespace sks
