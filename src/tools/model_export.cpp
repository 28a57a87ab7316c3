// SPDX-License-Identifier: BSD-3-Clause
#include "tools/model_export.hpp"

#include <cstdint>
#include <cstring>
#include <filesystem>

#include <sks_detector/stages/surface.hpp>

#include "io/confined_path.hpp"
#include "io/file.hpp"
#include "tools/meshing/greedy_triangles.hpp"

namespace sks::tools {
namespace {

void append(std::string& bytes, float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(char(bits >> shift & 0xff));
}

void append(std::string& bytes, std::int32_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(char(std::uint32_t(value) >> shift & 0xff));
}

std::string ply(const FusedModel& model, const std::vector<Eigen::Vector3i>& triangles) {
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment metres, model frame of sks_detector\n";
  text += "element vertex " + std::to_string(model.points.size()) + "\n";
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) text += std::string("property float ") + name + "\n";
  if (!model.colors.empty()) {
    for (const char* name : {"red", "green", "blue"}) text += std::string("property uchar ") + name + "\n";
  }
  if (!triangles.empty()) {
    text += "element face " + std::to_string(triangles.size()) + "\nproperty list uchar int vertex_indices\n";
  }
  text += "end_header\n";
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) append(text, model.points[i][axis]);
    for (int axis = 0; axis < 3; ++axis) append(text, model.normals[i][axis]);
    if (model.colors.empty()) continue;
    for (const std::uint8_t level : {model.colors[i].r, model.colors[i].g, model.colors[i].b}) {
      text.push_back(char(level));
    }
  }
  for (const Eigen::Vector3i& triangle : triangles) {
    text.push_back(3);
    for (int k = 0; k < 3; ++k) append(text, std::int32_t(triangle[k]));
  }
  return text;
}

/// About one point for each cube of the spacing.
FusedModel thinned(const FusedModel& model, double spacing) {
  const PointGrid grid(model.points, spacing);
  FusedModel thin;
  for (const std::uint32_t i : thinnedIndices(grid, spacing)) {
    const std::uint32_t source = grid.source[i];
    thin.points.push_back(model.points[source]);
    thin.normals.push_back(model.normals[source]);
    if (!model.colors.empty()) thin.colors.push_back(model.colors[source]);
  }
  return thin;
}

}  // namespace

void prepareModelExport(const std::string& folder, const std::vector<std::string>& objects) {
  for (const std::string& object : objects) checkFileName(object, "the object's name");
  makeFolder(folder);
}

std::vector<std::string> exportModel(const std::string& folder, const std::string& object, const FusedModel& model,
                                     double spacing) {
  std::vector<std::string> files;
  if (model.points.empty()) return files;
  const auto write = [&](const std::string& name, const std::string& content) {
    files.push_back((std::filesystem::path(folder) / name).string());
    writeFileAtomically(files.back(), content);
  };
  write(object + ".ply", ply(model, {}));
  const FusedModel thin = thinned(model, spacing);
  write(object + "_mesh.ply", ply(thin, greedyTriangles(thin.points, thin.normals, spacing)));
  return files;
}

}  // namespace sks::tools
