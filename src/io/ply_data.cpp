// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>

#include <sks_detector/error.hpp>

#include "io/ply_values.hpp"

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

/// Places of red, green and blue among the properties; incomplete where there is no colour.
std::array<std::size_t, 3> channels(const PlyElement& vertices) {
  auto indices = plyIndices<3>(vertices, {"red", "green", "blue"});
  if (!plyComplete(indices)) indices = plyIndices<3>(vertices, {"diffuse_red", "diffuse_green", "diffuse_blue"});
  for (const std::size_t i : indices) {
    if (i != ply_absent && vertices.properties[i].type != PointField::uint8) {
      badPly("property '" + vertices.properties[i].name + "' of its vertices must be uchar");
    }
  }
  return indices;
}

void readVertices(PlyValues& values, const PlyElement& element, double scale, Cloud& cloud) {
  const auto axes = coordinates(element), rgb = channels(element);
  const bool color = plyComplete(rgb);
  cloud.width = std::uint32_t(element.count);
  cloud.points.reserve(element.count);
  if (color) cloud.colors.reserve(element.count);
  const auto channel = [](double value) { return std::uint8_t(std::clamp(value, 0.0, 255.0)); };
  PlyInstance instance;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    values.read(element, instance);
    const std::vector<double>& row = instance.values;
    cloud.points.emplace_back(float(scale * row[axes[0]]), float(scale * row[axes[1]]), float(scale * row[axes[2]]));
    if (color) cloud.colors.push_back({channel(row[rgb[0]]), channel(row[rgb[1]]), channel(row[rgb[2]])});
  }
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
