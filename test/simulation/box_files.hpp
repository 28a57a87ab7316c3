// SPDX-License-Identifier: BSD-3-Clause
// A box whose six sides have a colour each, written in the ways that meshes come in.
#pragma once

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <sks_detector/simulation/mesh.hpp>

#include "io/image_file.hpp"
#include "temporary_folder.hpp"

namespace sks::test {

const Eigen::Vector3f box_size(0.14f, 0.09f, 0.06f);  // [m]
/// By side: -x, +x, -y, +y, -z, +z.
const std::array<Rgb, 6> side_colors = {
    {{200, 20, 20}, {20, 200, 20}, {20, 20, 200}, {200, 200, 20}, {200, 20, 200}, {20, 200, 200}}};

/// Four corners for each side, counter-clockwise seen from outside; two triangles of each four.
inline std::vector<Eigen::Vector3f> boxCorners() {
  std::vector<Eigen::Vector3f> corners;
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int k = 0; k < 4; ++k) {
      const int step = side % 2 == 1 ? k : 3 - k;
      Eigen::Vector3f corner = Eigen::Vector3f::Zero();
      corner[axis] = side % 2 == 1 ? box_size[axis] : 0;
      corner[u] = step == 1 || step == 2 ? box_size[u] : 0;
      corner[v] = step >= 2 ? box_size[v] : 0;
      corners.push_back(corner);
    }
  }
  return corners;
}

inline std::vector<std::array<int, 3>> boxTriangles() {
  std::vector<std::array<int, 3>> triangles;
  for (int side = 0; side < 6; ++side) {
    triangles.push_back({4 * side, 4 * side + 1, 4 * side + 2});
    triangles.push_back({4 * side, 4 * side + 2, 4 * side + 3});
  }
  return triangles;
}

/// A picture with a square of each side's colour, from left to right.
inline ColorImage boxAtlas() {
  constexpr int edge = 16;
  ColorImage image(6 * edge, edge);
  for (int row = 0; row < edge; ++row) {
    for (int column = 0; column < 6 * edge; ++column) image(row, column) = side_colors[std::size_t(column / edge)];
  }
  return image;
}

/// Where in the atlas a corner of a side lies: in the middle of its square.
inline Eigen::Vector2f atlasUv(int side, int corner) {
  return {(float(side) + (corner % 2 == 0 ? 0.4f : 0.6f)) / 6, corner < 2 ? 0.4f : 0.6f};
}

inline int sideOf(const Mesh& mesh, std::size_t triangle) {
  Eigen::Index axis = 0;
  mesh.areaVector(triangle).cwiseAbs().maxCoeff(&axis);
  const Eigen::AlignedBox3f box = mesh.box();
  return int(2 * axis + (mesh.point(triangle, 0.3f, 0.3f)[axis] > box.center()[axis] ? 1 : 0));
}

/// The mesh has the colours by side, the size and the surface of the box.
inline void expectColoredBox(const Mesh& mesh, std::size_t triangles = 12) {
  ASSERT_EQ(mesh.triangles.size(), triangles);
  EXPECT_TRUE(mesh.box().sizes().isApprox(box_size, 1e-4f)) << mesh.box().sizes().transpose();
  ASSERT_TRUE(mesh.hasColor());
  double area = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Rgb color = mesh.color(i, 0.3f, 0.3f, 0), right = side_colors[std::size_t(sideOf(mesh, i))];
    EXPECT_NEAR(color.r, right.r, 1) << i;
    EXPECT_NEAR(color.g, right.g, 1) << i;
    EXPECT_NEAR(color.b, right.b, 1) << i;
    area += double(mesh.areaVector(i).norm());
  }
  EXPECT_NEAR(area, 2 * (0.14 * 0.09 + 0.09 * 0.06 + 0.06 * 0.14), 1e-6);
}

/// The same without colour.
inline void expectPlainBox(const Mesh& mesh, const Eigen::Vector3f& size = box_size) {
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_TRUE(mesh.box().sizes().isApprox(size, 1e-4f)) << mesh.box().sizes().transpose();
  EXPECT_FALSE(mesh.hasColor());
}

/// Writes the numbers of a PLY file in one of its three formats.
class PlyText {
public:
  explicit PlyText(std::string format) : format_(std::move(format)) { header_ = "ply\nformat " + format_ + " 1.0\n"; }
  PlyText& line(const std::string& text) {
    header_ += text + "\n";
    return *this;
  }
  PlyText& number(const std::string& type, double value) {
    if (format_ == "ascii") {
      data_ += std::to_string(value).substr(
          0, type == "float" || type == "double" ? 12 : std::to_string(long(value)).size());
      data_ += " ";
    } else if (type == "uchar") {
      bytes(std::uint8_t(value));
    } else if (type == "ushort") {
      bytes(std::uint16_t(value));
    } else if (type == "int") {
      bytes(std::int32_t(value));
    } else if (type == "float") {
      bytes(float(value));
    } else {
      bytes(value);
    }
    return *this;
  }
  PlyText& endInstance() {
    if (format_ == "ascii") data_ += "\n";
    return *this;
  }
  std::string text() const { return header_ + "end_header\n" + data_; }

private:
  template <typename T>
  void bytes(T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (format_ == "binary_big_endian") std::reverse(raw, raw + sizeof(T));
    data_.append(raw, sizeof(T));
  }

  std::string format_, header_, data_;
};

/// A PLY file of the box with colours of vertices.
/// @param names of the channels, empty for none @param range of a channel: 255, 65535 or 1
inline std::string boxPly(const std::string& format, const std::array<const char*, 3>& names,
                          const std::string& type = "uchar", double range = 255, bool alpha = false) {
  PlyText ply(format);
  ply.line("comment a box").line("element vertex 24");
  for (const char* axis : {"x", "y", "z"}) ply.line(std::string("property float ") + axis);
  const bool color = *names[0] != 0;
  for (const char* name : names) {
    if (color) ply.line("property " + type + " " + name);
  }
  if (alpha) ply.line("property " + type + " alpha");
  ply.line("element face 12").line("property list uchar int vertex_indices");
  const auto corners = boxCorners();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) ply.number("float", double(corners[i][axis]));
    const Rgb& side = side_colors[i / 4];
    for (const int channel : {int(side.r), int(side.g), int(side.b)}) {
      if (color) ply.number(type, channel * range / 255);
    }
    if (alpha) ply.number(type, 0);
    ply.endInstance();
  }
  for (const auto& triangle : boxTriangles()) {
    ply.number("uchar", 3);
    for (const int corner : triangle) ply.number("int", corner);
    ply.endInstance();
  }
  return ply.text();
}

/// The vertices of an OBJ file of the box. @param scale units per metre
inline std::string boxObjVertices(float scale = 1) {
  std::string text;
  for (const Eigen::Vector3f& corner : boxCorners()) {
    text += "v";
    for (int axis = 0; axis < 3; ++axis) text += " " + std::to_string(scale * corner[axis]);
    text += "\n";
  }
  return text;
}

/// An OBJ file of the box with texture coordinates in the atlas, which `materials` may name.
inline std::string boxObj(const std::string& head, float scale = 1) {
  std::string text = head + boxObjVertices(scale);
  for (int i = 0; i < 24; ++i) {
    const Eigen::Vector2f uv = atlasUv(i / 4, i % 4);
    text += "vt " + std::to_string(uv.x()) + " " + std::to_string(uv.y()) + "\n";
  }
  for (int side = 0; side < 6; ++side) {
    if (head.find("usemtl each") != std::string::npos) text += "usemtl side" + std::to_string(side) + "\n";
    text += "f";
    for (int k = 1; k <= 4; ++k) text += " " + std::to_string(4 * side + k) + "/" + std::to_string(4 * side + k);
    text += "\n";
  }
  return text;
}

}  // namespace sks::test
