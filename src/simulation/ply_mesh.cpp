// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <sks_detector/error.hpp>

#include "io/memory_stream.hpp"
#include "io/ply_values.hpp"
#include "io/point_colors.hpp"
#include "simulation/file_mesh.hpp"

namespace sks {
namespace {

using PlacesUv = std::array<std::size_t, 2>;

/// Colours of the instances of one element, under any of their names.
class ColorProperties {
public:
  explicit ColorProperties(const PlyElement& element) : places_(colorChannelFields(plyValueNames(element))) {
    for (std::size_t i = 0; places_ && i < 3; ++i) types_[i] = element.properties[(*places_)[i]].type;
  }
  bool there() const { return places_.has_value(); }
  void add(const PlyInstance& instance) {
    if (!places_) return;
    const auto value = [&](std::size_t i) { return float(instance.values[(*places_)[i]]); };
    channels_.emplace_back(value(0), value(1), value(2));
  }
  std::vector<Rgb> colors() const { return statedColors(channels_, types_); }

private:
  std::optional<std::array<std::size_t, 3>> places_;
  std::array<std::uint8_t, 3> types_{};
  std::vector<Eigen::Vector3f> channels_;
};

PlacesUv uvOf(const PlyElement& vertices) {
  PlacesUv places{ply_absent, ply_absent};
  for (const auto& names : std::array<std::array<const char*, 2>, 4>{
           {{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}}}) {
    places = plyIndices(vertices, names);
    if (plyComplete(places)) break;
  }
  return places;
}

std::size_t indexListOf(const PlyElement& element) {
  for (const char* name : {"vertex_indices", "vertex_index"}) {
    const std::size_t place = plyIndex(element, name, true);
    if (place != ply_absent) return place;
  }
  throw Error(ErrorCode::bad_data, "its element " + element.name + " has no list vertex_indices");
}

std::uint32_t vertexOf(double index) {
  return index >= 0 && index < double(missing_vertex) ? std::uint32_t(index) : missing_vertex;
}

/// Reads the elements of one file.
class PlyMeshReader {
public:
  explicit PlyMeshReader(const std::string& content)
      : file_(content.data(), content.size()), header_(readPlyHeader(file_)), values_(file_, header_.format) {
    bytes_left_ = content.size() - std::size_t(file_.tellg());
  }

  FileMesh read();

private:
  void readVertices(const PlyElement& element);
  void readFaces(const PlyElement& element);
  void readStrips(const PlyElement& element);
  void addStrip(const std::vector<double>& strip);
  void addCorner(double index, const std::vector<double>& texcoord, std::size_t corner);

  MemoryStream file_;
  PlyHeader header_;
  PlyValues values_;
  std::size_t bytes_left_ = 0;
  bool vertex_uv_ = false;
  FileMesh mesh_;
};

FileMesh PlyMeshReader::read() {
  for (const std::string& texture : header_.textures) {
    FileMaterial material;
    material.name = material.texture = texture;
    mesh_.materials.push_back(material);
  }
  for (const PlyElement& element : header_.elements) {
    if (element.count == 0) continue;
    checkElement(element, header_.format, bytes_left_);
    if (element.name == "vertex") {
      readVertices(element);
    } else if (element.name == "face") {
      readFaces(element);
    } else if (element.name == "tristrips") {
      readStrips(element);
    } else {
      values_.skip(element);
      if (element.name == "edge") mesh_.left_out["edges"] += element.count;
    }
  }
  if (mesh_.face_colors.size() != mesh_.faces.size()) mesh_.face_colors.clear();  // strips of triangles have none
  const bool vertex_colors = !mesh_.vertex_colors.empty();                        // faces may stand before vertices
  for (FileFace& face : mesh_.faces) face.vertex_colors = vertex_colors;
  if (vertex_uv_) {
    for (FileCorner& corner : mesh_.corners) {
      if (corner.uv < 0 && corner.vertex < mesh_.vertices.size()) corner.uv = std::int32_t(corner.vertex);
    }
  }
  if (!mesh_.uv.empty() && mesh_.materials.empty() && !vertex_colors && mesh_.face_colors.empty()) {
    mesh_.warnings.emplace_back(
        "it has texture coordinates, but names no picture: a line 'comment TextureFile NAME' in its header does");
  }
  return std::move(mesh_);
}

void PlyMeshReader::readVertices(const PlyElement& element) {
  const auto axes = plyIndices<3>(element, {"x", "y", "z"});
  const PlacesUv uv = uvOf(element);
  if (!plyComplete(axes)) throw Error(ErrorCode::bad_data, "its vertices have no x, y and z");
  if (!mesh_.vertices.empty()) throw Error(ErrorCode::bad_data, "its header has two elements vertex");
  vertex_uv_ = plyComplete(uv);
  if (vertex_uv_ && !mesh_.uv.empty()) throw Error(ErrorCode::bad_data, "its faces stand before its vertices");
  ColorProperties colors(element);
  PlyInstance instance;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    values_.read(element, instance);
    const std::vector<double>& row = instance.values;
    mesh_.vertices.emplace_back(float(row[axes[0]]), float(row[axes[1]]), float(row[axes[2]]));
    colors.add(instance);
    if (vertex_uv_) mesh_.uv.emplace_back(float(row[uv[0]]), float(row[uv[1]]));
  }
  mesh_.vertex_colors = colors.colors();
  if (colors.there() && mesh_.vertex_colors.empty()) {
    mesh_.warnings.emplace_back("colours of its vertices are not finite, so that it counts as one without them");
  }
}

void PlyMeshReader::readFaces(const PlyElement& element) {
  const std::size_t list = indexListOf(element), texcoord = plyIndex(element, "texcoord", true),
                    number = plyIndex(element, "texnumber");
  static const std::vector<double> none;
  const std::size_t before_element = mesh_.faces.size();
  ColorProperties colors(element);
  PlyInstance instance;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    values_.read(element, instance);
    const std::vector<double>& indices = instance.lists[list];
    const std::vector<double>& uv = texcoord == ply_absent ? none : instance.lists[texcoord];
    const bool mapped = uv.size() == 2 * indices.size();
    for (std::size_t k = 0; k < indices.size(); ++k) addCorner(indices[k], mapped ? uv : none, k);
    const double picture = number == ply_absent ? 0 : instance.values[number];
    const bool known = picture >= 0 && picture < double(mesh_.materials.size());
    const std::size_t before = mesh_.faces.size();
    mesh_.endFace(known ? int(picture) : -1, false);
    if (mesh_.faces.size() > before) colors.add(instance);
  }
  if (before_element == 0) mesh_.face_colors = colors.colors();
}

void PlyMeshReader::addCorner(double index, const std::vector<double>& texcoord, std::size_t corner) {
  FileCorner added{vertexOf(index), -1};
  if (!texcoord.empty()) {
    added.uv = std::int32_t(mesh_.uv.size());
    mesh_.uv.emplace_back(float(texcoord[2 * corner]), float(texcoord[2 * corner + 1]));
  }
  mesh_.corners.push_back(added);
}

void PlyMeshReader::readStrips(const PlyElement& element) {
  const std::size_t list = indexListOf(element);
  const bool is_unsigned = element.properties[list].type == PointField::uint32;
  PlyInstance instance;
  std::vector<double> strip;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    values_.read(element, instance);
    for (const double index : instance.lists[list]) {
      const bool end = index == -1 || (is_unsigned && index == double(0xffffffff));
      if (!end) {
        strip.push_back(index);
        continue;
      }
      addStrip(strip);
      strip.clear();
    }
    addStrip(strip);  // -1 ends one within a list, the list itself the last one
    strip.clear();
  }
}

/// Every vertex from the third on makes a triangle with the two before it, the other way round each time. Strips are
/// continued elsewhere by triangles without area, which no face is made of.
void PlyMeshReader::addStrip(const std::vector<double>& strip) {
  static const std::vector<double> none;
  for (std::size_t k = 2; k < strip.size(); ++k) {
    double a = strip[k - 2], b = strip[k - 1];
    if (a == b || b == strip[k] || a == strip[k]) continue;
    if (k % 2 == 1) std::swap(a, b);
    for (const double index : {a, b, strip[k]}) addCorner(index, none, 0);
    mesh_.endFace(mesh_.materials.empty() ? -1 : 0, false);
  }
}

}  // namespace

FileMesh readPlyMesh(const std::string& content) {
  if (content.rfind("ply", 0) != 0) throw Error(ErrorCode::bad_data, "it is no PLY file");
  return PlyMeshReader(content).read();
}

}  // namespace sks
