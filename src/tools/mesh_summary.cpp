// SPDX-License-Identifier: BSD-3-Clause
#include "tools/mesh_summary.hpp"

#include <cmath>

#include "tools/table.hpp"

namespace sks::tools {
namespace {

Eigen::Vector3d sizeInMillimetres(const Mesh& mesh) {
  return 1000 * mesh.box().sizes().cast<double>();
}

std::string share(std::size_t triangles, const Mesh& mesh) {
  return fixed(100 * double(triangles) / double(mesh.triangles.size()), 1) + " %";
}

}  // namespace

std::string meshText(const std::string& path, const LoadedMesh& loaded) {
  const Mesh& mesh = loaded.mesh;
  const MeshColors& colors = loaded.file_colors;
  const Eigen::Vector3d size = sizeInMillimetres(mesh);
  std::string text = path + ": mesh of " + std::to_string(mesh.triangles.size()) + " triangles, " +
                     std::to_string(mesh.vertices.size()) + " vertices\n";
  text += "size: " + fixed(size.x(), 1) + " x " + fixed(size.y(), 1) + " x " + fixed(size.z(), 1) + " mm, unit " +
          (loaded.states_unit ? "stated by the file" : "not stated by the file") + "\n";
  if (!loaded.up_axis.empty()) {
    text += "up axis " + loaded.up_axis + " in the file is not applied: its axes are kept, as in rviz and MoveIt\n";
  }
  text += "triangles with a texture: " + share(colors.textured, mesh) +
          ", with another colour: " + share(colors.painted, mesh) + ", without colour: " + share(colors.none, mesh) +
          "\n";
  text += std::string("used ") + (mesh.hasColor() ? "with colour" : "without colour, by its shape alone") + "\n";
  for (const Texture& texture : mesh.textures) {
    text += "texture of " + std::to_string(texture.width()) + " x " + std::to_string(texture.height()) + " pixels\n";
  }
  return text;
}

nlohmann::json meshJson(const std::string& path, const LoadedMesh& loaded) {
  const Mesh& mesh = loaded.mesh;
  const Eigen::Vector3d size = sizeInMillimetres(mesh);
  nlohmann::json textures = nlohmann::json::array();
  for (const Texture& texture : mesh.textures) {
    textures.push_back({{"width", texture.width()}, {"height", texture.height()}});
  }
  return {{"mesh", path},
          {"triangles", mesh.triangles.size()},
          {"vertices", mesh.vertices.size()},
          {"size_mm", {size.x(), size.y(), size.z()}},
          {"states_unit", loaded.states_unit},
          {"unused_up_axis", loaded.up_axis},
          {"color", mesh.hasColor()},
          {"triangles_textured", loaded.file_colors.textured},
          {"triangles_painted", loaded.file_colors.painted},
          {"triangles_without_color", loaded.file_colors.none},
          {"textures", textures},
          {"warnings", loaded.warnings}};
}

}  // namespace sks::tools
