// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>

#include <sks_detector/error.hpp>

#include "io/number_text.hpp"
#include "io/point_colors.hpp"
#include "io/point_fields.hpp"
#include "simulation/file_mesh.hpp"
#include "simulation/text_lines.hpp"

namespace sks {
namespace {

/// Reads one file.
class ObjReader {
public:
  ObjReader(const std::string& content, const MeshFiles& files) : lines_(content), files_(files) {}

  FileMesh read();

private:
  [[noreturn]] void fail(const std::string& message) const {
    throw Error(ErrorCode::bad_data, "line " + std::to_string(lines_.number()) + ": " + message);
  }
  float number(std::size_t word) const;
  void readVertex();
  void readFace();
  std::size_t index(std::string_view text, std::size_t count) const;
  void useMaterial();
  void readLibraries();
  void addLibrary(const std::string& name, std::map<std::string, FileMaterial>& materials);

  TextLines lines_;
  const MeshFiles& files_;
  FileMesh mesh_;
  std::vector<Eigen::Vector3f> channels_;  // of the vertices that have a colour; zeros of the others
  std::vector<std::uint8_t> colored_;      // by vertex
  std::vector<std::string> libraries_;
  std::map<std::string, int> used_;  // materials by name
  int material_ = -1;
};

FileMesh ObjReader::read() {
  while (lines_.next()) {
    const std::string_view keyword = lines_.words()[0];
    if (keyword == "v") {
      readVertex();
    } else if (keyword == "vt") {
      mesh_.uv.emplace_back(number(1), lines_.words().size() > 2 ? number(2) : 0.0f);
    } else if (keyword == "f" || keyword == "fo") {
      readFace();
    } else if (keyword == "usemtl") {
      useMaterial();
    } else if (keyword == "mtllib") {
      libraries_.push_back(lines_.after(1));
    } else if (keyword == "l" || keyword == "p") {
      ++mesh_.left_out["lines and points"];
    } else if (keyword == "curv" || keyword == "curv2" || keyword == "surf") {
      ++mesh_.left_out["curves and curved surfaces"];
    }
  }
  const bool any_color = std::find(colored_.begin(), colored_.end(), 1) != colored_.end();
  constexpr std::array<std::uint8_t, 3> reals{PointField::float32, PointField::float32, PointField::float32};
  if (any_color) mesh_.vertex_colors = statedColors(channels_, reals);
  for (FileFace& face : mesh_.faces) {
    face.vertex_colors = !mesh_.vertex_colors.empty();
    for (std::size_t k = face.first; face.vertex_colors && k < face.first + face.count; ++k) {
      const std::uint32_t vertex = mesh_.corners[k].vertex;
      face.vertex_colors = vertex < colored_.size() && colored_[vertex] != 0;
    }
  }
  readLibraries();
  return std::move(mesh_);
}

float ObjReader::number(std::size_t word) const {
  double value = 0;
  if (word >= lines_.words().size()) fail("a number is missing");
  const std::string text(lines_.words()[word]);
  if (!parseNumber(text, value)) fail("'" + text.substr(0, 40) + "' is no number");
  return float(value);
}

/// x y z, perhaps with a weight, or with a colour, as MeshLab writes it.
void ObjReader::readVertex() {
  mesh_.vertices.emplace_back(number(1), number(2), number(3));
  const bool color = lines_.words().size() > 6;
  colored_.push_back(color ? 1 : 0);
  channels_.push_back(color ? Eigen::Vector3f(number(4), number(5), number(6)) : Eigen::Vector3f::Zero());
}

/// From the text of a corner; what counts from the end is negative.
std::size_t ObjReader::index(std::string_view text, std::size_t count) const {
  std::int64_t value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size()) {
    fail("'" + std::string(text.substr(0, 40)) + "' is no index");
  }
  const std::int64_t index = value < 0 ? std::int64_t(count) + value : value - 1;
  return index >= 0 && index < std::int64_t(missing_vertex) ? std::size_t(index) : missing_vertex;
}

void ObjReader::readFace() {
  for (std::size_t k = 1; k < lines_.words().size(); ++k) {
    const std::string_view corner = lines_.words()[k];
    const std::size_t slash = std::min(corner.find('/'), corner.size());
    FileCorner added{std::uint32_t(index(corner.substr(0, slash), mesh_.vertices.size())), -1};
    std::string_view uv = corner.substr(std::min(slash + 1, corner.size()));
    uv = uv.substr(0, uv.find('/'));
    if (!uv.empty()) {
      const std::size_t place = index(uv, mesh_.uv.size());
      if (place > 0x7ffffffe) fail("texture coordinate '" + std::string(uv) + "' is not in the file");
      added.uv = std::int32_t(place);
    }
    mesh_.corners.push_back(added);
  }
  mesh_.endFace(material_, false);
}

void ObjReader::useMaterial() {
  const std::string name = lines_.after(1);
  const auto [found, is_new] = used_.try_emplace(name, int(mesh_.materials.size()));
  if (is_new) {
    mesh_.materials.emplace_back();
    mesh_.materials.back().name = name;
  }
  material_ = found->second;
}

void ObjReader::addLibrary(const std::string& name, std::map<std::string, FileMaterial>& materials) {
  try {
    readMaterials(files_.find(name), materials);
    return;
  } catch (const Error&) {
    if (name.find(' ') == std::string::npos) throw;
  }
  std::istringstream names(name);  // it is no name with blanks: then these are several
  for (std::string word; names >> word;) readMaterials(files_.find(word), materials);
}

void ObjReader::readLibraries() {
  std::map<std::string, FileMaterial> materials;
  std::string names;
  std::sort(libraries_.begin(), libraries_.end());
  libraries_.erase(std::unique(libraries_.begin(), libraries_.end()), libraries_.end());
  for (const std::string& name : libraries_) {
    names += (names.empty() ? "'" : ", '") + name + "'";
    try {
      addLibrary(name, materials);
    } catch (const Error& error) {
      mesh_.warnings.push_back("its materials '" + name + "' cannot be read (" + error.what() +
                               "); put the file beside the mesh");
    }
  }
  std::vector<bool> shown(mesh_.materials.size(), false);
  for (const FileFace& face : mesh_.faces) {
    if (face.material >= 0) shown[std::size_t(face.material)] = true;
  }
  std::string unknown;
  for (std::size_t i = 0; i < mesh_.materials.size(); ++i) {
    FileMaterial& material = mesh_.materials[i];
    const auto found = materials.find(material.name);
    if (found != materials.end()) {
      material = found->second;
    } else if (shown[i] && unknown.size() < 200) {
      unknown += (unknown.empty() ? "'" : ", '") + material.name + "'";
    }
  }
  if (unknown.empty()) return;
  mesh_.warnings.push_back(libraries_.empty() ? "it uses the materials " + unknown +
                                                    ", but names no file of materials (a line 'mtllib NAME.mtl' does)"
                                              : "the materials " + unknown + " that it uses are not in " + names);
}

}  // namespace

FileMesh readObjMesh(const std::string& content, const MeshFiles& files) {
  return ObjReader(content, files).read();
}

}  // namespace sks
