// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/mesh_assembly.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <unordered_map>

#include <sks_detector/error.hpp>

#include "simulation/polygon.hpp"

namespace sks {
namespace {

constexpr float farthest_vertex = 1e9f;            // [unit of the file]; 1000 km in millimetres
constexpr float farthest_uv = 1e4f;                // pictures that repeat more often are no pictures any more
constexpr std::uint64_t most_texels = 1ull << 28;  // of all textures of a mesh

[[noreturn]] void badMesh(const std::string& message) {
  throw Error(ErrorCode::bad_data, message);
}

struct CornerTriangle {
  std::array<std::size_t, 3> corners;
  std::size_t face;
};

/// Where the colour of a face comes from.
enum class ColorSource { none, texture, vertices, plain };

/// Makes one mesh of one file.
class Assembly {
public:
  Assembly(const FileMesh& file, const MeshFiles& files) : file_(file), files_(files) {}

  LoadedMesh make();

private:
  void checkCorners() const;
  void checkTextureCoordinates() const;
  void cutFaces();
  void loadTextures();
  bool mapped(const FileFace& face) const;
  ColorSource sourceOf(std::size_t face) const;
  Rgb plainColor(std::size_t face) const;
  void count();
  void addTriangle(const CornerTriangle& triangle, ColorSource paint);
  int vertexOf(const FileCorner& corner, ColorSource paint, const Rgb& plain);

  /// What makes vertices of the mesh out of one of the file: its texture coordinate, and a colour of the face.
  using Key = std::tuple<std::uint32_t, std::int32_t, std::uint32_t>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::uint64_t hash = std::get<0>(key) * 0x9e3779b97f4a7c15ull;
      hash = (hash ^ (hash >> 29) ^ std::uint32_t(std::get<1>(key))) * 0xbf58476d1ce4e5b9ull;
      return std::size_t((hash ^ (hash >> 32) ^ std::get<2>(key)) * 0x94d049bb133111ebull);
    }
  };

  const FileMesh& file_;
  const MeshFiles& files_;
  std::vector<CornerTriangle> triangles_;
  std::vector<int> texture_of_;  // by material; -1: none
  std::map<std::string, std::size_t> left_out_;
  std::unordered_map<Key, int, Hash> known_;
  bool colored_ = false;
  LoadedMesh result_;
};

LoadedMesh Assembly::make() {
  left_out_ = file_.left_out;
  result_.warnings = file_.warnings;
  checkCorners();
  checkTextureCoordinates();
  cutFaces();
  if (triangles_.empty()) badMesh("it has no triangles; a point cloud goes with `kind: model` or `kind: view`");
  loadTextures();
  count();
  for (const CornerTriangle& triangle : triangles_) {
    addTriangle(triangle, colored_ ? sourceOf(triangle.face) : ColorSource::none);
  }
  if (!colored_) result_.mesh.textures.clear();
  std::string left_out;
  for (const auto& [what, number] : left_out_) {
    left_out += (left_out.empty() ? "left out: " : ", ") + what + " (" + std::to_string(number) + ")";
  }
  if (!left_out.empty()) result_.warnings.push_back(left_out);
  return std::move(result_);
}

void Assembly::checkCorners() const {
  for (const FileCorner& corner : file_.corners) {
    if (corner.vertex >= file_.vertices.size()) {
      badMesh("it has a face with a vertex that is not in the file; copy it again");
    }
    if (!(file_.vertices[corner.vertex].array().abs() <= farthest_vertex).all()) {
      badMesh(
          "it has a vertex that is not finite or lies farther than a billion units away; repair it in a mesh editor");
    }
    if (corner.uv < 0) continue;
    if (std::size_t(corner.uv) >= file_.uv.size()) {
      badMesh("it has a face with a texture coordinate that is not in the file; copy it again");
    }
  }
}

/// Whether or not the texture can be read.
void Assembly::checkTextureCoordinates() const {
  for (const FileFace& face : file_.faces) {
    if (face.material < 0 || !mapped(face)) continue;
    const FileMaterial& material = file_.materials[std::size_t(face.material)];
    if (material.texture.empty() && !material.picture) continue;
    for (std::size_t k = face.first; k < face.first + face.count; ++k) {
      if ((file_.uv[std::size_t(file_.corners[k].uv)].array().abs() <= farthest_uv).all()) continue;
      badMesh("it has a texture coordinate that is not finite or larger than " + std::to_string(int(farthest_uv)) +
              "; repair it in a mesh editor");
    }
  }
}

void Assembly::cutFaces() {
  std::vector<Eigen::Vector3f> polygon;
  for (std::size_t i = 0; i < file_.faces.size(); ++i) {
    const FileFace& face = file_.faces[i];
    polygon.clear();
    for (std::size_t k = 0; k < face.count; ++k) {
      polygon.push_back(file_.vertices[file_.corners[face.first + k].vertex]);
    }
    bool any_area = false;
    for (const PolygonTriangle& t : triangulate(polygon)) {
      const Eigen::Vector3f ab = polygon[t[1]] - polygon[t[0]], ac = polygon[t[2]] - polygon[t[0]];
      if (!(ab.cast<double>().cross(ac.cast<double>()).squaredNorm() > 0)) continue;
      any_area = true;
      triangles_.push_back({{face.first + t[0], face.first + t[1], face.first + t[2]}, i});
    }
    if (!any_area) ++left_out_["faces without area"];
  }
}

/// Textures that no face shows are not read.
void Assembly::loadTextures() {
  std::vector<std::size_t> shown(file_.materials.size(), 0);
  for (const CornerTriangle& triangle : triangles_) {
    const FileFace& face = file_.faces[triangle.face];
    if (face.material >= 0 && mapped(face)) ++shown[std::size_t(face.material)];
  }
  texture_of_.assign(file_.materials.size(), -1);
  std::map<std::pair<std::string, std::string>, int> known;
  std::uint64_t texels = 0;
  for (std::size_t i = 0; i < file_.materials.size(); ++i) {
    const FileMaterial& material = file_.materials[i];
    if (shown[i] == 0 || (material.texture.empty() && !material.picture)) continue;
    const auto earlier = known.find({material.file, material.texture});
    if (earlier != known.end() && !material.picture) {
      texture_of_[i] = earlier->second;
      continue;
    }
    try {
      if (!material.problem.empty()) throw Error(ErrorCode::bad_data, material.problem);
      ColorImage image =
          material.picture ? *material.picture : readColorImage(files_.find(material.texture, material.file));
      texels += image.pixels.size();
      if (texels > most_texels) throw Error(ErrorCode::bad_data, "all textures together have too many pixels");
      texture_of_[i] = int(result_.mesh.textures.size());
      result_.mesh.textures.emplace_back(image.width, image.height, std::move(image.pixels));
    } catch (const Error& error) {
      result_.warnings.push_back("its texture '" + material.texture + "' cannot be used (" + error.what() + "); " +
                                 std::to_string(shown[i]) + " triangles show it");
    }
    if (!material.picture) known[{material.file, material.texture}] = texture_of_[i];
  }
}

/// Whether all corners have texture coordinates.
bool Assembly::mapped(const FileFace& face) const {
  const auto corner = file_.corners.begin() + std::ptrdiff_t(face.first);
  return std::all_of(corner, corner + std::ptrdiff_t(face.count), [](const FileCorner& c) { return c.uv >= 0; });
}

ColorSource Assembly::sourceOf(std::size_t index) const {
  const FileFace& face = file_.faces[index];
  if (face.material >= 0 && texture_of_[std::size_t(face.material)] >= 0 && mapped(face)) return ColorSource::texture;
  if (face.vertex_colors) return ColorSource::vertices;
  if (!file_.face_colors.empty()) return ColorSource::plain;
  if (face.material < 0) return ColorSource::none;
  // The colour of a material with a texture only dyes that: without it, it says nothing.
  const FileMaterial& material = file_.materials[std::size_t(face.material)];
  return material.color && material.texture.empty() && !material.picture ? ColorSource::plain : ColorSource::none;
}

Rgb Assembly::plainColor(std::size_t index) const {
  if (!file_.face_colors.empty()) return file_.face_colors[index];
  return file_.materials[std::size_t(file_.faces[index].material)].color.value_or(Rgb{});
}

void Assembly::count() {
  MeshColors& colors = result_.file_colors;
  for (const CornerTriangle& triangle : triangles_) {
    const ColorSource paint = sourceOf(triangle.face);
    ++(paint == ColorSource::texture ? colors.textured : paint == ColorSource::none ? colors.none : colors.painted);
  }
  colored_ = colors.none == 0;
  const bool expected =
      std::any_of(file_.faces.begin(), file_.faces.end(), [](const FileFace& f) { return f.material >= 0; });
  if (colored_ || (colors.textured + colors.painted == 0 && !expected)) return;
  result_.warnings.push_back(std::to_string(colors.none) + " of its " + std::to_string(triangles_.size()) +
                             " triangles have no colour, so that it is used without colour, by its shape alone; give "
                             "all of it a colour in a mesh editor to have it used with colour");
}

int Assembly::vertexOf(const FileCorner& corner, ColorSource paint, const Rgb& plain) {
  const std::int32_t uv = paint == ColorSource::texture ? corner.uv : -1;
  const std::uint32_t color =
      paint == ColorSource::plain ? 0x1000000u | unsigned(plain.r) << 16 | unsigned(plain.g) << 8 | plain.b : 0;
  Mesh& mesh = result_.mesh;
  const auto [found, is_new] = known_.try_emplace({corner.vertex, uv, color}, int(mesh.vertices.size()));
  if (!is_new) return found->second;
  mesh.vertices.push_back(file_.vertices[corner.vertex]);
  if (result_.file_colors.painted > 0 && colored_) {
    const bool own = paint == ColorSource::vertices || (paint == ColorSource::texture && !file_.vertex_colors.empty());
    mesh.colors.push_back(own ? file_.vertex_colors[corner.vertex] : plain);
  }
  if (colored_ && !mesh.textures.empty()) {
    mesh.texture_uv.push_back(uv < 0 ? Eigen::Vector2f(0, 0) : file_.uv[std::size_t(uv)]);
  }
  return found->second;
}

void Assembly::addTriangle(const CornerTriangle& triangle, ColorSource paint) {
  const Rgb plain = paint == ColorSource::plain ? plainColor(triangle.face) : Rgb{};
  Eigen::Vector3i corners;
  for (std::size_t k = 0; k < 3; ++k) {
    corners[Eigen::Index(k)] = vertexOf(file_.corners[triangle.corners[k]], paint, plain);
  }
  Mesh& mesh = result_.mesh;
  mesh.triangles.push_back(corners);
  if (!colored_ || mesh.textures.empty()) return;
  const int material = file_.faces[triangle.face].material;
  mesh.triangle_texture.push_back(paint == ColorSource::texture ? texture_of_[std::size_t(material)] : -1);
}

}  // namespace

LoadedMesh assembleMesh(const FileMesh& file, const MeshFiles& files) {
  return Assembly(file, files).make();
}

}  // namespace sks
