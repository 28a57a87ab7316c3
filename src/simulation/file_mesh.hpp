// SPDX-License-Identifier: BSD-3-Clause
// A mesh as its file states it, before triangles and colours are made of it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <sks_detector/cloud.hpp>

#include "io/image_file.hpp"
#include "simulation/mesh_files.hpp"

namespace sks {

struct FileCorner {
  std::uint32_t vertex = 0;
  std::int32_t uv = -1;  ///< -1: none
};

/// A polygon.
struct FileFace {
  std::size_t first = 0;       ///< of its corners
  std::size_t count = 0;       ///< of corners
  int material = -1;           ///< -1: none
  bool vertex_colors = false;  ///< its vertices have colours
};

struct FileMaterial {
  std::string name;
  std::optional<Rgb> color;           ///< where the file states one
  std::string texture;                ///< name of the picture; empty: none
  std::string file;                   ///< that names it; empty: the mesh
  std::optional<ColorImage> picture;  ///< where it is in the file itself
  std::string problem;                ///< why the texture cannot be used; empty: nothing is known
};

struct FileMesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Rgb> vertex_colors;  ///< one for each vertex, or empty
  std::vector<Eigen::Vector2f> uv;
  std::vector<FileCorner> corners;
  std::vector<FileFace> faces;
  std::vector<Rgb> face_colors;  ///< one for each face, or empty
  std::vector<FileMaterial> materials;
  bool in_metres = false;  ///< the file states its unit, and the vertices are in metres
  std::string up_axis;     ///< as in LoadedMesh

  std::map<std::string, std::size_t> left_out;  ///< what of the file is not used, and how often it is there
  std::vector<std::string> warnings;            ///< without the name of the file

  /// Adds a face with the corners that were added since the last one; fewer than three are left out.
  void endFace(int material, bool colored_vertices) {
    const std::size_t first = faces.empty() ? 0 : faces.back().first + faces.back().count;
    if (corners.size() - first < 3) {
      corners.resize(first);
      ++left_out["faces with fewer than three corners"];
      return;
    }
    faces.push_back({first, corners.size() - first, material, colored_vertices});
  }
};

/// Index of a corner whose vertex or texture coordinate is not in the file.
constexpr std::uint32_t missing_vertex = 0xffffffff;

// Readers by format. @throws Error without the name of the file
FileMesh readPlyMesh(const std::string& content);
FileMesh readStlMesh(const std::string& content);
FileMesh readObjMesh(const std::string& content, const MeshFiles& files);
/// What assimp reads: DAE, and glTF, whose unit is always the metre.
FileMesh readAssimpMesh(const MeshFiles& files);

/// The materials of an MTL file, added to those that there are. @throws Error(bad_file) without its name
void readMaterials(const std::string& path, std::map<std::string, FileMaterial>& materials);

}  // namespace sks
