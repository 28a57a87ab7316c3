// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <memory>

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include <sks_detector/error.hpp>

#include "simulation/assimp_files.hpp"
#include "simulation/file_mesh.hpp"

namespace sks {
namespace {

[[noreturn]] void badScene(const std::string& message) {
  throw Error(ErrorCode::bad_data, message);
}

/// What assimp's own steps take for granted: over a face without corners they end the program, vertices that are not
/// there they read all the same.
void checkFaces(const aiScene& scene) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& part = *scene.mMeshes[m];
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
      const aiFace& face = part.mFaces[i];
      if (face.mNumIndices == 0) badScene("it has a face without corners; repair it in a mesh editor");
      const bool there = std::all_of(face.mIndices, face.mIndices + face.mNumIndices,
                                     [&](unsigned index) { return index < part.mNumVertices; });
      if (!there) badScene("it has a face with a vertex that is not in the file; copy it again");
    }
  }
}

/// COLLADA files have `<unit meter="0.01"/>`, and assimp then scales to metres. Without it the unit is not known.
bool statesUnit(const std::string& content) {
  for (std::size_t at = content.find("<unit"); at != std::string::npos; at = content.find("<unit", at + 1)) {
    const std::string tag = content.substr(at, std::min(content.find('>', at), content.size()) - at);
    if (tag.find("meter") != std::string::npos) return true;
  }
  return false;
}

/// `<up_axis>Y_UP</up_axis>`; nothing where it is z, as in ROS, or not stated.
std::string otherUpAxis(const std::string& content) {
  for (const char* axis : {"X_UP", "Y_UP"}) {
    const std::size_t at = content.find(axis), tag = content.rfind("<up_axis>", at);
    if (at != std::string::npos && tag != std::string::npos && content.find('<', tag + 1) > at) return axis;
  }
  return "";
}

Rgb rgbOf(const aiColor4D& color) {
  const auto byte = [](float value) {
    return std::uint8_t(std::lround(255 * (std::isfinite(value) ? std::clamp(value, 0.0f, 1.0f) : 0.0f)));
  };
  return {byte(color.r), byte(color.g), byte(color.b)};
}

/// What assimp fills in where a file states no colour: grey for COLLADA, white for glTF.
bool stated(const aiColor4D& color, bool gltf) {
  const float unstated = gltf ? 1.0f : 0.6f;
  return color.r != unstated || color.g != unstated || color.b != unstated;
}

void addTexture(const aiScene& scene, const aiMaterial& source, FileMaterial& material) {
  aiString name;
  if (source.GetTexture(aiTextureType_DIFFUSE, 0, &name) != aiReturn_SUCCESS) return;
  material.texture = name.C_Str();
  aiUVTransform moved;
  if (source.Get(AI_MATKEY_UVTRANSFORM(aiTextureType_DIFFUSE, 0), moved) == aiReturn_SUCCESS &&
      (moved.mTranslation != aiVector2D(0, 0) || moved.mScaling != aiVector2D(1, 1) || moved.mRotation != 0)) {
    material.problem = "it is moved or scaled, which is not understood";
  }
  const aiTexture* inside = scene.GetEmbeddedTexture(name.C_Str());
  if (inside == nullptr || inside->mHeight != 0) return;
  try {
    material.picture = decodeColorImage(std::string(reinterpret_cast<const char*>(inside->pcData), inside->mWidth));
  } catch (const Error& error) {
    material.problem = error.what();
  }
}

FileMaterial materialOf(const aiScene& scene, const aiMaterial& source, bool gltf) {
  FileMaterial material;
  material.name = source.GetName().C_Str();
  addTexture(scene, source, material);
  aiColor4D color;
  const bool own = material.name != AI_DEFAULT_MATERIAL_NAME;
  if (own && source.Get(AI_MATKEY_COLOR_DIFFUSE, color) == aiReturn_SUCCESS && stated(color, gltf)) {
    material.color = rgbOf(color);
  }
  return material;
}

/// Which of the sets of texture coordinates a material's texture is laid out by.
unsigned uvSetOf(const aiMaterial& material) {
  int set = 0;
  const bool there = material.Get(AI_MATKEY_UVWSRC(aiTextureType_DIFFUSE, 0), set) == aiReturn_SUCCESS;
  return there && set >= 0 && set < AI_MAX_NUMBER_OF_TEXTURECOORDS ? unsigned(set) : 0;
}

/// Adds one of assimp's meshes, which are in one frame by now.
void addPart(const aiMesh& part, const aiMaterial& material, FileMesh& mesh) {
  const unsigned uv_set = uvSetOf(material);
  const bool own = std::string(material.GetName().C_Str()) != AI_DEFAULT_MATERIAL_NAME;
  const std::size_t first = mesh.vertices.size(), first_uv = mesh.uv.size();
  const bool colors = part.HasVertexColors(0), uv = part.HasTextureCoords(uv_set);
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& v = part.mVertices[i];
    mesh.vertices.emplace_back(v.x, v.y, v.z);
    mesh.vertex_colors.push_back(colors ? rgbOf(part.mColors[0][i]) : Rgb{});
    if (uv) mesh.uv.emplace_back(part.mTextureCoords[uv_set][i].x, part.mTextureCoords[uv_set][i].y);
  }
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    for (unsigned k = 0; k < face.mNumIndices; ++k) {
      const std::size_t index = face.mIndices[k];
      mesh.corners.push_back({std::uint32_t(first + index), uv ? std::int32_t(first_uv + index) : -1});
    }
    mesh.endFace(own ? int(part.mMaterialIndex) : -1, colors);
  }
}

}  // namespace

FileMesh readAssimpMesh(const MeshFiles& files) {
  const bool gltf = files.ending() != ".dae";
  const std::string content = files.readMesh();  // says better than assimp why it cannot be read
  Assimp::Importer importer;
  importer.SetIOHandler(std::make_unique<AssimpFiles>(files).release());         // the importer deletes it
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);  // the file's own axes are the model's
  const aiScene* scene = importer.ReadFile(files.mesh(), 0);
  if (scene != nullptr) {
    checkFaces(*scene);
    scene = importer.ApplyPostProcessing(aiProcess_PreTransformVertices);
  }
  if (scene == nullptr) badScene(importer.GetErrorString());
  FileMesh mesh;
  for (unsigned i = 0; i < scene->mNumMaterials; ++i) {
    mesh.materials.push_back(materialOf(*scene, *scene->mMaterials[i], gltf));
  }
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
    const aiMesh& part = *scene->mMeshes[i];
    addPart(part, *scene->mMaterials[part.mMaterialIndex], mesh);
  }
  mesh.in_metres = gltf || statesUnit(content);
  if (!gltf) mesh.up_axis = otherUpAxis(content);
  return mesh;
}

}  // namespace sks
