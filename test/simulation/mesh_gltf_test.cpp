// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulation/box_files.hpp"
#include "simulation/mesh_file.hpp"

namespace sks {
namespace {

using ::testing::HasSubstr;

class GltfMesh : public test::MeshFileTest {};

std::string base64(const std::string& bytes) {
  const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      value = value << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0);
    }
    for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[value >> (18 - 6 * k) & 63];
  }
  return text;
}

/// 24 positions, 24 texture coordinates and 36 indices of the box.
std::string boxBuffer() {
  std::string bytes;
  const auto append = [&](auto value) {
    char raw[sizeof(value)];
    std::memcpy(raw, &value, sizeof(value));
    bytes.append(raw, sizeof(value));
  };
  for (const Eigen::Vector3f& corner : test::boxCorners()) {
    for (int axis = 0; axis < 3; ++axis) append(corner[axis]);
  }
  for (int i = 0; i < 24; ++i) {
    const Eigen::Vector2f uv = test::atlasUv(i / 4, i % 4);
    append(uv.x());
    append(1 - uv.y());  // from the top
  }
  for (const auto& triangle : test::boxTriangles()) {
    for (const int corner : triangle) append(std::uint16_t(corner));
  }
  return bytes;
}

/// @param buffer, image URIs @param material the members of its pbrMetallicRoughness
std::string boxGltf(const std::string& buffer, const std::string& image, const std::string& material) {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0}]}],
"materials": [{"pbrMetallicRoughness": {)" +
         material + R"(}}], "textures": [{"source": 0}], "images": [{"uri": ")" + image + R"("}],
"buffers": [{"uri": ")" +
         buffer + R"(", "byteLength": 552}],
"bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 288},
{"buffer": 0, "byteOffset": 288, "byteLength": 192}, {"buffer": 0, "byteOffset": 480, "byteLength": 72}],
"accessors": [
{"bufferView": 0, "componentType": 5126, "count": 24, "type": "VEC3", "min": [0, 0, 0], "max": [0.14, 0.09, 0.06]},
{"bufferView": 1, "componentType": 5126, "count": 24, "type": "VEC2"},
{"bufferView": 2, "componentType": 5123, "count": 36, "type": "SCALAR"}]})";
}

const std::string textured = "\"baseColorTexture\": {\"index\": 0}";

TEST_F(GltfMesh, FilesBesideItAndDataInItAreRead) {
  write("box.bin", boxBuffer());
  const std::string png = encodePng(test::boxAtlas());
  write("atlas.png", png);
  const std::string in_it = "data:application/octet-stream;base64," + base64(boxBuffer());
  for (const std::string& buffer : {std::string("box.bin"), in_it}) {
    for (const std::string& image : {std::string("atlas.png"), "data:image/png;base64," + base64(png)}) {
      const LoadedMesh loaded = loadMesh(write("a.gltf", boxGltf(buffer, image, textured)), 0.001);
      test::expectColoredBox(loaded.mesh);
      EXPECT_TRUE(loaded.states_unit);
    }
  }
}

TEST_F(GltfMesh, ColoursThatAreNotStatedAreNone) {
  write("box.bin", boxBuffer());
  EXPECT_FALSE(loadMesh(write("a.gltf", boxGltf("box.bin", "gone.png", ""))).mesh.hasColor());
  const LoadedMesh gone = loadMesh(write("b.gltf", boxGltf("box.bin", "gone.png", textured)));
  EXPECT_FALSE(gone.mesh.hasColor());
  ASSERT_FALSE(gone.warnings.empty());
  EXPECT_THAT(gone.warnings[0], HasSubstr("gone.png"));
  const Mesh red = loadMesh(write("c.gltf", boxGltf("box.bin", "gone.png", "\"baseColorFactor\": [1, 0, 0, 1]"))).mesh;
  ASSERT_TRUE(red.hasColor());
  EXPECT_EQ(red.color(0, 0.3f, 0.3f, 0).g, 0);
}

TEST_F(GltfMesh, WithoutItsDataItIsRefused) {
  EXPECT_THAT(refusal(write("a.gltf", boxGltf("gone.bin", "", ""))), HasSubstr("a.gltf': "));
}

}  // namespace
}  // namespace sks
