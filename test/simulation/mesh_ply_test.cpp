// SPDX-License-Identifier: BSD-3-Clause
// PLY meshes as scanners and editors write them: by content, not only that something is read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulation/box_files.hpp"
#include "simulation/mesh_file.hpp"

namespace sks {
namespace {

using test::boxPly;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::array<const char*, 3> usual_names = {"red", "green", "blue"};
const std::vector<std::string> ply_formats = {"ascii", "binary_little_endian", "binary_big_endian"};

class PlyMesh : public test::MeshFileTest {};

TEST_F(PlyMesh, WithoutColourHasNone) {
  for (const std::string& format : ply_formats) {
    const LoadedMesh loaded = loadMesh(write("a.ply", boxPly(format, {"", "", ""})));
    test::expectPlainBox(loaded.mesh);
    EXPECT_THAT(loaded.warnings, IsEmpty());
    EXPECT_EQ(loaded.file_colors.none, 12u);
  }
}

TEST_F(PlyMesh, ColoursGoByManyNamesAndTypes) {
  struct Kind {
    const char* type;
    double range;
  };
  const std::vector<std::array<const char*, 3>> names = {
      usual_names, {"diffuse_red", "diffuse_green", "diffuse_blue"}, {"r", "g", "b"}};
  for (const std::string& format : ply_formats) {
    for (const auto& channels : names) {
      for (const Kind& kind : {Kind{"uchar", 255}, Kind{"ushort", 65535}, Kind{"ushort", 255}, Kind{"int", 255},
                               Kind{"float", 1}, Kind{"float", 255}, Kind{"double", 1}}) {
        SCOPED_TRACE(format + " " + channels[0] + " " + kind.type + " " + std::to_string(kind.range));
        const LoadedMesh loaded = loadMesh(write("a.ply", boxPly(format, channels, kind.type, kind.range)));
        test::expectColoredBox(loaded.mesh);
        EXPECT_EQ(loaded.file_colors.painted, 12u);
      }
    }
  }
}

TEST_F(PlyMesh, AlphaIsNotUsed) {
  test::expectColoredBox(
      loadMesh(write("a.ply", boxPly("binary_little_endian", usual_names, "uchar", 255, true))).mesh);
}

TEST_F(PlyMesh, ColoursThatAreNotFiniteAreNone) {
  const LoadedMesh loaded =
      loadMesh(write("a.ply",
                     "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                     "property float red\nproperty float green\nproperty float blue\nelement face 1\n"
                     "property list uchar int vertex_indices\nend_header\n0 0 0 1 0 0\n0.1 0 0 nan 0 0\n0 0.1 0 1 1 1\n"
                     "3 0 1 2\n"));
  EXPECT_FALSE(loaded.mesh.hasColor());
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_THAT(loaded.warnings[0], HasSubstr("not finite"));
}

TEST_F(PlyMesh, AllLineEndsAreRead) {
  std::string text = boxPly("ascii", usual_names);
  for (const std::string end : {"\r\n", "\r"}) {
    std::string other;
    for (const char c : text) other += c == '\n' ? end : std::string(1, c);
    test::expectColoredBox(loadMesh(write("a.ply", other)).mesh);
  }
  // binary data behind such a header
  std::string binary = boxPly("binary_little_endian", usual_names);
  const std::size_t size = binary.find("end_header\n") + 11;
  std::replace(binary.begin(), binary.begin() + std::ptrdiff_t(size), '\n', '\r');
  test::expectColoredBox(loadMesh(write("a.ply", binary)).mesh);
}

/// A box with two pictures or one, whose texture coordinates stand at the faces.
std::string wedgePly(const std::string& format, int pictures, bool polygons = false) {
  test::PlyText ply(format);
  ply.line("comment VCGLIB generated");
  if (pictures == 1) ply.line("comment TextureFile atlas.png");
  if (pictures == 2) ply.line("comment TextureFile low.png").line("comment TextureFile my high.png");
  ply.line("element vertex 24").line("property float x").line("property float y").line("property float z");
  ply.line(polygons ? "element face 6" : "element face 12").line("property list uchar int vertex_indices");
  ply.line("property list uchar float texcoord");
  if (pictures == 2) ply.line("property int texnumber");
  for (const Eigen::Vector3f& corner : test::boxCorners()) {
    for (int axis = 0; axis < 3; ++axis) ply.number("float", double(corner[axis]));
    ply.endInstance();
  }
  const auto face = [&](const std::vector<int>& corners) {
    ply.number("uchar", double(corners.size()));
    for (const int corner : corners) ply.number("int", corner);
    ply.number("uchar", double(2 * corners.size()));
    const int side = corners[0] / 4;
    for (const int corner : corners) {
      const Eigen::Vector2f uv = test::atlasUv(side, corner % 4);
      ply.number("float", double(uv.x())).number("float", double(uv.y()));
    }
    if (pictures == 2) ply.number("int", side < 3 ? 0 : 1);
    ply.endInstance();
  };
  for (int side = 0; side < 6; ++side) {
    const int a = 4 * side;
    if (polygons) face({a, a + 1, a + 2, a + 3});
    if (!polygons) {
      face({a, a + 1, a + 2});
      face({a, a + 2, a + 3});
    }
  }
  return ply.text();
}

TEST_F(PlyMesh, TextureCoordinatesOfFacesGiveTheColoursOfThePicture) {
  write("atlas.png", encodePng(test::boxAtlas()));
  for (const std::string& format : ply_formats) {
    for (const bool polygons : {false, true}) {
      const LoadedMesh loaded = loadMesh(write("a.ply", wedgePly(format, 1, polygons)));
      test::expectColoredBox(loaded.mesh);
      EXPECT_EQ(loaded.file_colors.textured, 12u);
      EXPECT_THAT(loaded.warnings, IsEmpty());
    }
  }
}

TEST_F(PlyMesh, SeveralPicturesAreToldApartByTheirNumber) {
  ColorImage low = test::boxAtlas(), high = low;
  for (int row = 0; row < low.height; ++row) {
    for (int column = 0; column < low.width; ++column) {
      (column < low.width / 2 ? high : low)(row, column) = {1, 2, 3};
    }
  }
  write("low.png", encodePng(low));
  write("my high.png", encodePng(high));
  for (const std::string& format : ply_formats) {
    test::expectColoredBox(loadMesh(write("a.ply", wedgePly(format, 2))).mesh);
  }
}

TEST_F(PlyMesh, WithoutItsPictureItHasNoColour) {
  const LoadedMesh gone = loadMesh(write("a.ply", wedgePly("ascii", 1)));
  test::expectPlainBox(gone.mesh);
  ASSERT_FALSE(gone.warnings.empty());
  EXPECT_THAT(gone.warnings[0], HasSubstr("its texture 'atlas.png' cannot be used (it does not exist); 12 triangles"));
  const LoadedMesh unnamed = loadMesh(write("b.ply", wedgePly("ascii", 0)));
  test::expectPlainBox(unnamed.mesh);
  ASSERT_FALSE(unnamed.warnings.empty());
  EXPECT_THAT(unnamed.warnings[0], HasSubstr("comment TextureFile NAME"));
}

TEST_F(PlyMesh, OnePictureOfTwoIsNotEnough) {
  write("low.png", encodePng(test::boxAtlas()));
  const LoadedMesh loaded = loadMesh(write("a.ply", wedgePly("ascii", 2)));
  test::expectPlainBox(loaded.mesh);
  EXPECT_EQ(loaded.file_colors.textured, 6u);
  EXPECT_EQ(loaded.file_colors.none, 6u);
  ASSERT_EQ(loaded.warnings.size(), 2u);
  EXPECT_THAT(loaded.warnings[0], HasSubstr("'my high.png'"));
  EXPECT_THAT(loaded.warnings[1], HasSubstr("6 of its 12 triangles have no colour"));
}

const std::string strip_head =
    "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
    "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
    "0 0 0\n0 0 0.06\n0 0.09 0\n0 0.09 0.06\n0.14 0 0\n0.14 0 0.06\n0.14 0.09 0\n0.14 0.09 0.06\n";

TEST_F(PlyMesh, StripsOfTrianglesAreReadWhole) {
  const Mesh mesh =
      loadMesh(write("a.ply", strip_head + "30 0 1 2 3 -1 4 6 5 7 -1 0 4 1 5 -1 2 3 6 7 -1 0 2 4 6 -1 1 5 3 7 -1\n"))
          .mesh;
  test::expectPlainBox(mesh);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {  // every other one is turned, so that all face outwards
    EXPECT_GT(mesh.areaVector(i).dot(mesh.point(i, 0.3f, 0.3f) - mesh.box().center()), 0) << i;
  }
  // one strip, continued by triangles without area, and no -1 at its end
  const Mesh continued =
      loadMesh(write("b.ply", strip_head + "34 0 1 2 3 3 4 4 6 5 7 7 0 0 4 1 5 5 2 2 3 6 7 7 0 0 2 4 6 6 1 1 5 3 7\n"))
          .mesh;
  test::expectPlainBox(continued);
}

TEST_F(PlyMesh, FacesMayHaveColours) {
  test::PlyText ply("ascii");
  ply.line("element vertex 24").line("property float x").line("property float y").line("property float z");
  ply.line("element face 6").line("property list uchar uint vertex_index");
  for (const char* name : usual_names) ply.line(std::string("property uchar ") + name);
  std::string text = ply.text();
  for (const Eigen::Vector3f& c : test::boxCorners()) {
    text += std::to_string(c.x()) + " " + std::to_string(c.y()) + " " + std::to_string(c.z()) + "\n";
  }
  for (int side = 0; side < 6; ++side) {
    const Rgb& rgb = test::side_colors[std::size_t(side)];
    text += "4";
    for (int k = 0; k < 4; ++k) text += " " + std::to_string(4 * side + k);
    for (const int c : {int(rgb.r), int(rgb.g), int(rgb.b)}) text += " " + std::to_string(c);
    text += "\n";
  }
  test::expectColoredBox(loadMesh(write("a.ply", text)).mesh);
}

TEST_F(PlyMesh, HugeTextureCoordinatesAreRefused) {
  write("atlas.png", encodePng(test::boxAtlas()));
  for (const char* uv : {"1e9", "-3.4e38", "inf", "nan"}) {
    const std::string text =
        "ply\nformat ascii 1.0\ncomment TextureFile atlas.png\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nproperty float s\nproperty float t\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n0 0 0 0 0\n0.1 0 0 0 " +
        std::string(uv) + "\n0 0.1 0 0 0\n3 0 1 2\n";
    EXPECT_THAT(refusal(write("a.ply", text)),
                HasSubstr("a texture coordinate that is not finite or larger than 10000"));
  }
}

TEST_F(PlyMesh, WhatIsLeftOutIsCounted) {
  const LoadedMesh loaded =
      loadMesh(write("a.ply",
                     "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                     "element face 4\nproperty list uchar int vertex_indices\nelement edge 2\nproperty int vertex1\n"
                     "property int vertex2\nend_header\n0 0 0\n0.1 0 0\n0 0.1 0\n0.2 0 0\n3 0 1 2\n2 0 1\n0\n3 0 1 3\n"
                     "0 1\n1 2\n"));
  EXPECT_EQ(loaded.mesh.triangles.size(), 1u);
  EXPECT_THAT(loaded.warnings,
              ElementsAre(folder_.path("a.ply") +
                          ": left out: edges (2), faces with fewer than three corners (2), faces without area (1)"));
}

}  // namespace
}  // namespace sks
