// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include <sks_detector/error.hpp>
#include <sks_detector/simulation/mesh.hpp>

#include "core/settings/value_text.hpp"
#include "simulation/mesh_assembly.hpp"

namespace sks {
namespace {

constexpr double largest_in_metres = 5;                      // what is wider across must be given in millimetres
constexpr double smallest_mesh = 0.001, largest_mesh = 100;  // across [m]

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw Error(ErrorCode::bad_file, "cannot read mesh '" + path + "': " + reason);
}

/// Of the dozens of formats that assimp reads, those that are tested.
FileMesh readFileMesh(const MeshFiles& files) {
  const std::string ending = files.ending();
  if (ending == ".ply") return readPlyMesh(files.readMesh());
  if (ending == ".stl") return readStlMesh(files.readMesh());
  if (ending == ".obj") return readObjMesh(files.readMesh(), files);
  if (isMeshName(files.mesh())) return readAssimpMesh(files);
  throw Error(
      ErrorCode::bad_data,
      "it is not called like an OBJ, PLY, STL, DAE or glTF file; other formats can be converted in a mesh editor, "
      "for example by MeshLab or Blender");
}

std::string sizeText(const Eigen::Vector3f& sizes, double scale) {
  std::string text;
  for (int axis = 0; axis < 3; ++axis) {
    const double size = double(sizes[axis]) * scale,
                 rounded = size < 10 ? std::round(10 * size) / 10 : std::round(size);
    text += (axis == 0 ? "" : " x ") + toText(rounded);
  }
  return text;
}

/// To metres. A scale of the caller is for files that do not state their unit.
void applyScale(double scale, bool in_metres, LoadedMesh& loaded) {
  const Eigen::Vector3f sizes = loaded.mesh.box().sizes();
  const double diagonal = sizes.cast<double>().norm();
  if (!(diagonal > 0)) throw Error(ErrorCode::bad_data, "all its vertices lie at one position");
  loaded.states_unit = in_metres;
  if (in_metres) {
    scale = 1;
  } else if (scale <= 0) {
    scale = diagonal > largest_in_metres ? 0.001 : 1;
    if (scale < 1) {
      loaded.warnings.push_back("it measures " + sizeText(sizes, 1) +
                                " units, which are taken for millimetres; where they are others, say so by `units:` of "
                                "the data set or by --scale");
    }
  }
  if (!(diagonal * scale >= smallest_mesh && diagonal * scale <= largest_mesh)) {
    throw Error(ErrorCode::bad_data, "it would be " + sizeText(sizes, 1000 * scale) +
                                         " mm large, and can be from 1 mm to 100 m; is its unit "
                                         "another one? See `units:` of the data set and --scale");
  }
  for (Eigen::Vector3f& v : loaded.mesh.vertices) v *= float(scale);
}

}  // namespace

bool isMeshName(const std::string& path) {
  const std::string ending = MeshFiles(path, "").ending();
  const std::array<const char*, 6> known = {".ply", ".stl", ".obj", ".dae", ".gltf", ".glb"};
  return std::find(known.begin(), known.end(), ending) != known.end();
}

LoadedMesh loadMesh(const std::string& path, double scale, const std::string& folder) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    fail(path, "it is a folder; give the name of a mesh file");
  }
  if (!std::filesystem::exists(path, ignored)) fail(path, "it does not exist");
  if (!(std::isfinite(scale) && scale < 1e6)) fail(path, "the scale must be less than a million metres per unit");
  try {
    const MeshFiles files(std::filesystem::absolute(path).string(), folder);
    const FileMesh file = readFileMesh(files);
    LoadedMesh loaded = assembleMesh(file, files);
    loaded.up_axis = file.up_axis;
    applyScale(scale, file.in_metres, loaded);
    for (std::string& warning : loaded.warnings) warning = path + ": " + warning;
    return loaded;
  } catch (const Error& error) {
    fail(path, error.what());
  }
}

}  // namespace sks
