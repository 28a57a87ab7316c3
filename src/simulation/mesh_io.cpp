// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/simulation/mesh.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include <sks_detector/error.hpp>

#include "io/image_file.hpp"
#include "io/ply_file.hpp"

namespace sks {
namespace {

namespace fs = std::filesystem;

constexpr double largest_in_metres = 5;  // what is wider across must be given in millimetres

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw Error(ErrorCode::bad_file, "cannot read mesh '" + path + "': " + reason);
}

std::uint8_t toByte(float fraction) {
  return std::uint8_t(std::lround(255 * std::clamp(fraction, 0.0f, 1.0f)));
}

Rgb toRgb(const aiColor4D& color) {
  return {toByte(color.r), toByte(color.g), toByte(color.b)};
}

/// Gathers the parts of one file into one mesh.
class MeshReader {
public:
  MeshReader(const std::string& path, const aiScene& scene) : path_(path), scene_(scene) {}

  LoadedMesh read() {
    readTextures();
    for (unsigned i = 0; i < scene_.mNumMeshes; ++i) any_color_ |= isColored(*scene_.mMeshes[i]);
    for (unsigned i = 0; i < scene_.mNumMeshes; ++i) add(*scene_.mMeshes[i]);
    return std::move(result_);
  }

private:
  void readTextures();
  Texture readTexture(const std::string& name);
  void add(const aiMesh& part);

  int textureOf(const aiMesh& part) const {
    return part.HasTextureCoords(0) ? texture_of_material_[part.mMaterialIndex] : -1;
  }
  bool isColored(const aiMesh& part) const {
    const aiMaterial& material = *scene_.mMaterials[part.mMaterialIndex];
    aiColor4D ignored;
    const bool own_material = std::strcmp(material.GetName().C_Str(), AI_DEFAULT_MATERIAL_NAME) != 0;
    return part.HasVertexColors(0) || textureOf(part) >= 0 ||
           (own_material && material.Get(AI_MATKEY_COLOR_DIFFUSE, ignored) == AI_SUCCESS);
  }

  std::string path_;
  const aiScene& scene_;
  LoadedMesh result_;
  std::vector<int> texture_of_material_;
  bool any_color_ = false;
};

void MeshReader::readTextures() {
  for (unsigned i = 0; i < scene_.mNumMaterials; ++i) {
    texture_of_material_.push_back(-1);
    aiString name;
    if (scene_.mMaterials[i]->GetTexture(aiTextureType_DIFFUSE, 0, &name) != AI_SUCCESS) continue;
    Texture texture = readTexture(name.C_Str());
    if (texture.width() == 0) continue;
    texture_of_material_.back() = int(result_.mesh.textures.size());
    result_.mesh.textures.push_back(std::move(texture));
  }
}

Texture MeshReader::readTexture(const std::string& name) {
  std::string file = name;
  std::replace(file.begin(), file.end(), '\\', '/');
  file.erase(file.find_last_not_of(" \t\r") + 1);  // MTL files of scanners end lines with a space
  file = (fs::path(path_).parent_path() / file).lexically_normal().string();
  std::string reason = "it does not exist";
  std::error_code ignored;
  try {
    if (fs::is_regular_file(file, ignored)) {
      ColorImage image = readColorImage(file);
      return {image.width, image.height, std::move(image.pixels)};
    }
  } catch (const Error& error) {
    reason = error.what();
  }
  result_.warnings.push_back(path_ + ": its texture '" + file + "' cannot be read (" + reason +
                             "); the mesh has no colour there");
  return {};
}

void MeshReader::add(const aiMesh& part) {
  Mesh& mesh = result_.mesh;
  const int first = int(mesh.vertices.size()), texture = textureOf(part);
  aiColor4D diffuse(0.7f, 0.7f, 0.7f, 1);
  scene_.mMaterials[part.mMaterialIndex]->Get(AI_MATKEY_COLOR_DIFFUSE, diffuse);
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& v = part.mVertices[i];
    mesh.vertices.emplace_back(v.x, v.y, v.z);
    if (any_color_) mesh.colors.push_back(toRgb(part.HasVertexColors(0) ? part.mColors[0][i] : diffuse));
    if (mesh.textures.empty()) continue;
    const aiVector3D uv = part.HasTextureCoords(0) ? part.mTextureCoords[0][i] : aiVector3D();
    mesh.texture_uv.emplace_back(uv.x, uv.y);
  }
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices != 3) continue;
    mesh.triangles.emplace_back(first + int(face.mIndices[0]), first + int(face.mIndices[1]),
                                first + int(face.mIndices[2]));
    if (!mesh.textures.empty()) mesh.triangle_texture.push_back(texture);
  }
}

void check(const std::string& path, const Mesh& mesh) {
  constexpr float farthest_vertex = 1e9f;  // [unit of the file]; 1000 km in millimetres
  if (mesh.triangles.empty()) fail(path, "it has no triangles; a point cloud goes with `kind: model` or `kind: view`");
  for (const Eigen::Vector3f& v : mesh.vertices) {
    if (!(v.array().abs() <= farthest_vertex).all()) {
      fail(path,
           "it has a vertex that is not finite or lies farther than a billion units away; repair it in a mesh editor");
    }
  }
  for (const Eigen::Vector2f& uv : mesh.texture_uv) {
    if (!uv.allFinite()) fail(path, "it has a texture coordinate that is not finite; repair it in a mesh editor");
  }
}

void applyScale(const std::string& path, double scale, LoadedMesh& loaded) {
  const double diagonal = loaded.mesh.box().diagonal().norm();
  if (!(diagonal > 0)) fail(path, "all its vertices lie at one position");
  if (scale <= 0) {
    scale = diagonal > largest_in_metres ? 0.001 : 1;
    if (scale < 1) {
      loaded.warnings.push_back(path + ": it measures " + std::to_string(long(diagonal)) +
                                " units across, which is taken for millimetres");
    }
  }
  for (Eigen::Vector3f& v : loaded.mesh.vertices) v *= float(scale);
}

/// Assimp looks for the end of a PLY header line by line, for ever if it finds none: lines must be such that it splits
/// them as readPlyHeader() does.
void checkHeaderLines(std::istream& file) {
  const std::array<const char*, 7> keywords = {"ply",     "format",   "comment",   "obj_info",
                                               "element", "property", "end_header"};
  std::string line;
  for (int number = 1; line != "end_header" && std::getline(file, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    const std::string keyword = line.substr(0, line.find_first_of(" \t"));
    const bool known = std::find(keywords.begin(), keywords.end(), keyword) != keywords.end();
    const bool text = std::none_of(line.begin(), line.end(), [](unsigned char c) { return c < ' ' && c != '\t'; });
    if (!known || !text || (keyword == "end_header" && line != keyword)) {
      throw Error(ErrorCode::bad_data, "its PLY header is damaged in line " + std::to_string(number));
    }
  }
}

/// Of the dozens of formats that assimp reads, those that are tested. The header of a PLY file is read by us first:
/// over one that is cut off assimp's reader never ends.
void checkFormat(const std::string& path) {
  std::string ending = fs::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  const std::array<const char*, 4> known = {".obj", ".ply", ".stl", ".dae"};
  if (std::find(known.begin(), known.end(), ending) == known.end()) {
    fail(path, "it is not called like an OBJ, PLY, STL or DAE file");
  }
  if (ending != ".ply") return;
  std::ifstream file(path, std::ios::binary);
  try {
    readPlyHeader(file);
    file.seekg(0);
    checkHeaderLines(file);
  } catch (const Error& reason) {
    fail(path, reason.what());
  }
}

/// What assimp's own steps take for granted: over a face without corners they end the program, vertices that are not
/// there they read all the same.
void checkFaces(const std::string& path, const aiScene& scene) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& part = *scene.mMeshes[m];
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
      const aiFace& face = part.mFaces[i];
      if (face.mNumIndices == 0) fail(path, "it has a face without corners; repair it in a mesh editor");
      const bool there = std::all_of(face.mIndices, face.mIndices + face.mNumIndices,
                                     [&](unsigned index) { return index < part.mNumVertices; });
      if (!there) fail(path, "it has a face with a vertex that is not in the file; copy it again");
    }
  }
}

}  // namespace

LoadedMesh loadMesh(const std::string& path, double scale) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) fail(path, "it is a folder; give the name of an OBJ, PLY, STL or DAE file");
  if (!fs::exists(path, ignored)) fail(path, "it does not exist");
  checkFormat(path);
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);  // the file's own axes are the model's
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene = importer.ReadFile(path, 0);
  if (scene != nullptr) {
    checkFaces(path, *scene);
    scene = importer.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                                         aiProcess_PreTransformVertices | aiProcess_SortByPType);
  }
  if (scene == nullptr) fail(path, importer.GetErrorString());
  LoadedMesh loaded = MeshReader(path, *scene).read();
  check(path, loaded.mesh);
  applyScale(path, scale, loaded);
  return loaded;
}

}  // namespace sks
