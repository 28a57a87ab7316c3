// SPDX-License-Identifier: BSD-3-Clause
// A box of 140 x 90 x 60 mm that lacks two of its corners, so that no turn maps it onto itself, in squares of 10 mm
// with the colours of box_files.hpp by side; and the files that it can come in.
#pragma once

#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "simulation/box_files.hpp"

namespace sks::test {

/// A square of the surface.
struct Patch {
  int side = 0;                            ///< as in side_colors
  std::array<Eigen::Vector3i, 4> corners;  ///< counter-clockwise from outside [mm]
};

inline bool isInNotchedBox(const Eigen::Vector3i& cell) {
  if ((cell.array() < 0).any() || cell.x() >= 14 || cell.y() >= 9 || cell.z() >= 6) return false;
  const bool large = cell.x() >= 9 && cell.y() >= 5 && cell.z() >= 3;
  const bool small = cell.x() < 4 && cell.y() < 3 && cell.z() >= 4;
  return !large && !small;
}

inline std::vector<Patch> notchedBox() {
  std::vector<Patch> patches;
  for (int i = 0; i < 14 * 9 * 6; ++i) {
    const Eigen::Vector3i cell(i % 14, i / 14 % 9, i / (14 * 9));
    if (!isInNotchedBox(cell)) continue;
    for (int side = 0; side < 6; ++side) {
      const int axis = side / 2, u = (axis + 1) % 3, v = (axis + 2) % 3, out = side % 2;
      if (isInNotchedBox(cell + (2 * out - 1) * Eigen::Vector3i::Unit(axis))) continue;
      Patch patch;
      patch.side = side;
      for (int k = 0; k < 4; ++k) {
        const int step = out == 1 ? k : 3 - k;
        Eigen::Vector3i corner = cell + out * Eigen::Vector3i::Unit(axis);
        if (step == 1 || step == 2) corner += Eigen::Vector3i::Unit(u);
        if (step >= 2) corner += Eigen::Vector3i::Unit(v);
        patch.corners[std::size_t(k)] = 10 * corner;
      }
      patches.push_back(patch);
    }
  }
  return patches;
}

/// A corner as text. @param per_metre units of the file in a metre
inline std::string cornerText(const Eigen::Vector3i& corner, double per_metre) {
  char text[96];
  std::snprintf(text, sizeof(text), "%.9g %.9g %.9g", 1e-3 * per_metre * corner.x(), 1e-3 * per_metre * corner.y(),
                1e-3 * per_metre * corner.z());
  return text;
}

/// An OBJ file, with texture coordinates in boxAtlas(). @param head its first lines
inline std::string notchedObj(const std::string& head = "", double per_metre = 1) {
  std::string vertices, faces;
  int count = 0;
  for (const Patch& patch : notchedBox()) {
    for (std::size_t k = 0; k < 4; ++k) {
      const Eigen::Vector2f uv = atlasUv(patch.side, int(k));
      vertices += "v " + cornerText(patch.corners[k], per_metre) + "\nvt " + std::to_string(uv.x()) + " " +
                  std::to_string(uv.y()) + "\n";
    }
    for (const auto& triangle : {std::array<int, 3>{1, 2, 3}, std::array<int, 3>{1, 3, 4}}) {
      faces += "f";
      for (const int k : triangle) faces += " " + std::to_string(count + k) + "/" + std::to_string(count + k);
      faces += "\n";
    }
    count += 4;
  }
  return head + vertices + faces;
}

/// What a PLY file of it holds besides positions.
struct NotchedPly {
  std::string format = "ascii";
  std::array<const char*, 3> colors{"", "", ""};  ///< names of the channels of vertices; empty: none
  std::string type = "uchar";                     ///< of these
  double range = 255;                             ///< of these
  bool strips = false;                            ///< triangle strips in place of faces
  bool face_texture = false;                      ///< texture coordinates on faces, in atlas.png
};

inline std::string notchedPly(const NotchedPly& with = {}) {
  const std::vector<Patch> patches = notchedBox();
  PlyText ply(with.format);
  if (with.face_texture) ply.line("comment TextureFile atlas.png");
  ply.line("element vertex " + std::to_string(4 * patches.size()));
  for (const char* axis : {"x", "y", "z"}) ply.line(std::string("property float ") + axis);
  const bool colored = *with.colors[0] != 0;
  for (const char* name : with.colors) {
    if (colored) ply.line("property " + with.type + " " + name);
  }
  ply.line(with.strips ? "element tristrips 1" : "element face " + std::to_string(2 * patches.size()));
  ply.line(with.strips ? "property list int int vertex_indices" : "property list uchar int vertex_indices");
  if (with.face_texture) ply.line("property list uchar float texcoord");
  for (const Patch& patch : patches) {
    const Rgb& color = side_colors[std::size_t(patch.side)];
    for (const Eigen::Vector3i& corner : patch.corners) {
      for (int axis = 0; axis < 3; ++axis) ply.number("float", 1e-3 * corner[axis]);
      for (const int channel : {int(color.r), int(color.g), int(color.b)}) {
        if (colored) ply.number(with.type, channel * with.range / 255);
      }
      ply.endInstance();
    }
  }
  if (with.strips) ply.number("int", double(5 * patches.size()));
  for (int i = 0; i < int(patches.size()); ++i) {
    if (with.strips) {
      for (const int k : {1, 2, 0, 3}) ply.number("int", 4 * i + k);
      ply.number("int", -1);
      continue;
    }
    for (const auto& triangle : {std::array<int, 3>{0, 1, 2}, std::array<int, 3>{0, 2, 3}}) {
      ply.number("uchar", 3);
      for (const int k : triangle) ply.number("int", 4 * i + k);
      if (with.face_texture) {
        ply.number("uchar", 6);
        for (const int k : triangle) {
          const Eigen::Vector2f uv = atlasUv(patches[std::size_t(i)].side, k);
          ply.number("float", double(uv.x())).number("float", double(uv.y()));
        }
      }
      ply.endInstance();
    }
  }
  return ply.text();
}

inline std::string notchedStl(double per_metre = 1) {
  std::string text = "solid thing\n";
  for (const Patch& patch : notchedBox()) {
    for (const auto& triangle : {std::array<std::size_t, 3>{0, 1, 2}, std::array<std::size_t, 3>{0, 2, 3}}) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const std::size_t k : triangle) text += "vertex " + cornerText(patch.corners[k], per_metre) + "\n";
      text += "endloop\nendfacet\n";
    }
  }
  return text + "endsolid thing\n";
}

/// A COLLADA file that states its unit.
inline std::string notchedDae(const std::string& unit, double per_metre, const std::string& up_axis = "Z_UP") {
  const std::vector<Patch> patches = notchedBox();
  const std::string count = std::to_string(4 * patches.size());
  std::string numbers, indices;
  int first = 0;
  for (const Patch& patch : patches) {
    for (const Eigen::Vector3i& corner : patch.corners) numbers += cornerText(corner, per_metre) + " ";
    for (const int k : {0, 1, 2, 0, 2, 3}) indices += std::to_string(first + k) + " ";
    first += 4;
  }
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset>)" +
         unit + "<up_axis>" + up_axis + R"(</up_axis></asset><library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count=")" +
         std::to_string(12 * patches.size()) + "\">" + numbers +
         R"(</float_array><technique_common><accessor source="#pa" count=")" + count +
         R"(" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
</accessor></technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count=")" +
         std::to_string(2 * patches.size()) + R"("><input semantic="VERTEX" source="#v" offset="0"/><p>)" + indices +
         R"(</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"/></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

}  // namespace sks::test
