// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <sks_detector/cloud.hpp>
#include <sks_detector/simulation/texture.hpp>

namespace sks {

/// A surface of triangles, as it comes from a file or a generator. Its frame is the model frame of all that is trained
/// from it. Neither closed nor oriented: the virtual camera sees both sides of a triangle.
struct Mesh {
  std::vector<Eigen::Vector3f> vertices;    ///< [m]
  std::vector<Eigen::Vector3i> triangles;   ///< three vertices each
  std::vector<Rgb> colors;                  ///< of the vertices; empty, or one for each
  std::vector<Eigen::Vector2f> texture_uv;  ///< of the vertices; empty without textures
  std::vector<Texture> textures;
  std::vector<int> triangle_texture;  ///< of each triangle, -1: colours of the vertices; empty: all -1

  bool hasColor() const { return !colors.empty() || !textures.empty(); }
  /// Axis-aligned bounding box of the triangles [m].
  Eigen::AlignedBox3f box() const;
  /// Its half of the cross product of two edges: normal times area [m^2].
  Eigen::Vector3f areaVector(std::size_t triangle) const;
  /// Point of a triangle at the barycentric coordinates u, v of its second and third vertex.
  Eigen::Vector3f point(std::size_t triangle, float u, float v) const;
  /// Colour there. @param footprint edge of the surface that one pixel sees [m]; 0: a point
  Rgb color(std::size_t triangle, float u, float v, float footprint) const;
};

/// Where the colours of a file's triangles come from [triangles].
struct MeshColors {
  std::size_t textured = 0;  ///< from a picture
  std::size_t painted = 0;   ///< from colours of vertices, faces or materials
  std::size_t none = 0;      ///< the file states none; then the whole mesh is used without colour
};

/// A mesh from a file, and what is odd about it but can be used.
struct LoadedMesh {
  Mesh mesh;
  std::vector<std::string> warnings;  ///< each naming the file
  MeshColors file_colors;             ///< what the file states
  bool states_unit = false;           ///< the file states its unit: it was used, whatever scale was given
  std::string up_axis;                ///< what a DAE file calls upwards where that is not z, "Y_UP": it is not applied
};

/// Reads an OBJ, PLY, STL, DAE or glTF file with its textures and colours (docs/formats.md). A mesh has a colour only
/// where its file states one for all of it.
/// @param scale factor from the file's unit to metres, for files that do not state it; 0: recognised, a mesh of more
///        than 5 units across is taken for millimetres with a warning
/// @param folder no file outside of it is read, whatever the mesh names; empty: no confinement
/// @throws Error(bad_file) naming the file and what is wrong: missing, damaged, no triangles, not finite, no extent
LoadedMesh loadMesh(const std::string& path, double scale = 0, const std::string& folder = "");

/// Whether a file is called like one that loadMesh() reads: *.obj, *.ply, *.stl, *.dae, *.gltf, *.glb.
bool isMeshName(const std::string& path);

}  // namespace sks
