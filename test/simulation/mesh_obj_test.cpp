// SPDX-License-Identifier: BSD-3-Clause
// OBJ meshes and their materials.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulation/box_files.hpp"
#include "simulation/mesh_file.hpp"

namespace sks {
namespace {

using test::boxObj;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class ObjMesh : public test::MeshFileTest {
protected:
  void writeAtlas(const std::string& name = "atlas.png") const { write(name, encodePng(test::boxAtlas())); }
};

std::string sideMaterials(int first = 0, int last = 6) {
  std::string text;
  for (int side = first; side < last; ++side) {
    const Rgb& rgb = test::side_colors[std::size_t(side)];
    text += "newmtl side" + std::to_string(side) + "\nKa 1 1 1\nKd";
    for (const int c : {int(rgb.r), int(rgb.g), int(rgb.b)}) text += " " + std::to_string(c / 255.0);
    text += "\n\n";
  }
  return text;
}

TEST_F(ObjMesh, ATextureGivesItsColours) {
  writeAtlas();
  for (const char* map : {"map_Kd atlas.png", "map_Kd atlas.png \t", "\tmap_Kd  -s 1 1 1 -o 0 0 0 -blendu on atlas.png",
                          "map_kd .\\atlas.png", "Kd 0 0 0\nmap_Kd atlas.png", "map_Kd C:\\scans\\Atlas.PNG"}) {
    SCOPED_TRACE(map);
    write("a.mtl", std::string("newmtl m\n") + map + "\n");
    const LoadedMesh loaded = loadMesh(write("a.obj", boxObj("mtllib a.mtl\nusemtl m\n")));
    test::expectColoredBox(loaded.mesh);
    EXPECT_EQ(loaded.file_colors.textured, 12u);
    EXPECT_THAT(loaded.warnings, IsEmpty());
  }
}

TEST_F(ObjMesh, PicturesOfOtherKindsAreTextures) {
  write("atlas.jpg", encodeJpeg(ColorImage(16, 16, {90, 120, 30})));
  write("a.mtl", "newmtl m\nmap_Kd atlas.jpg\n");
  const Mesh mesh = loadMesh(write("a.obj", boxObj("mtllib a.mtl\nusemtl m\n"))).mesh;
  ASSERT_TRUE(mesh.hasColor());
  EXPECT_NEAR(mesh.color(3, 0.3f, 0.3f, 0).g, 120, 4);
}

TEST_F(ObjMesh, WithoutItsMaterialsItHasNoColour) {
  const LoadedMesh loaded = loadMesh(write("a.obj", boxObj("mtllib gone.mtl\nusemtl m\n")));
  test::expectPlainBox(loaded.mesh);
  EXPECT_THAT(loaded.warnings,
              ElementsAre(HasSubstr("a.obj: its materials 'gone.mtl' cannot be read (it does not exist); put the file"),
                          HasSubstr("the materials 'm' that it uses are not in 'gone.mtl'"),
                          HasSubstr("12 of its 12 triangles have no colour")));
}

/// Another one beside it is not meant.
TEST_F(ObjMesh, NoOtherMaterialsAreTaken) {
  write("a.mtl", "newmtl m\nKd 1 0 0\n");
  EXPECT_FALSE(loadMesh(write("a.obj", boxObj("mtllib gone.mtl\nusemtl m\n"))).mesh.hasColor());
  const LoadedMesh unnamed = loadMesh(write("a.obj", boxObj("usemtl m\n")));
  test::expectPlainBox(unnamed.mesh);
  ASSERT_FALSE(unnamed.warnings.empty());
  EXPECT_THAT(unnamed.warnings[0], HasSubstr("it uses the materials 'm', but names no file of materials"));
}

TEST_F(ObjMesh, AMaterialThatIsNotThereGivesNoColour) {
  write("a.mtl", "newmtl other\nKd 1 0 0\n");
  const LoadedMesh loaded = loadMesh(write("a.obj", boxObj("mtllib a.mtl\nusemtl m\n")));
  test::expectPlainBox(loaded.mesh);
  ASSERT_FALSE(loaded.warnings.empty());
  EXPECT_THAT(loaded.warnings[0], HasSubstr("the materials 'm' that it uses are not in 'a.mtl'"));
}

TEST_F(ObjMesh, AMaterialWithoutColourGivesNone) {
  for (const char* material : {"Ns 10\n", "Ka 1 1 1\n", "Kd spectral a.rfl 1\n", "Kd nan 0 0\n", "Kd\n"}) {
    SCOPED_TRACE(material);
    write("a.mtl", std::string("newmtl m\n") + material);
    EXPECT_FALSE(loadMesh(write("a.obj", boxObj("mtllib a.mtl\nusemtl m\n"))).mesh.hasColor());
  }
}

/// The colour of a material only dyes its texture: where that is gone, it says nothing.
TEST_F(ObjMesh, WithoutItsTextureItHasNoColour) {
  write("a.mtl", "newmtl m\nKd 0.8 0.8 0.8\nmap_Kd gone.png\n");
  const LoadedMesh loaded = loadMesh(write("a.obj", boxObj("mtllib a.mtl\nusemtl m\n")));
  test::expectPlainBox(loaded.mesh);
  ASSERT_FALSE(loaded.warnings.empty());
  EXPECT_THAT(loaded.warnings[0], HasSubstr("its texture 'gone.png' cannot be used (it does not exist)"));
}

TEST_F(ObjMesh, TexturesThatCannotBeShownRightAreNotShown) {
  writeAtlas();
  for (const char* option : {"-s 2 2 2", "-o 0.5", "-clamp on"}) {
    write("a.mtl", std::string("newmtl m\nmap_Kd ") + option + " atlas.png\n");
    const LoadedMesh loaded = loadMesh(write("a.obj", boxObj("mtllib a.mtl\nusemtl m\n")));
    test::expectPlainBox(loaded.mesh);
    ASSERT_FALSE(loaded.warnings.empty());
    EXPECT_THAT(loaded.warnings[0], HasSubstr("is not understood"));
  }
}

TEST_F(ObjMesh, HugeTextureCoordinatesAreRefused) {
  writeAtlas();
  write("a.mtl", "newmtl m\nmap_Kd atlas.png\n");
  for (const char* uv : {"1e9", "-3.4e38", "1e300"}) {
    const std::string text =
        "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nvt 0 0\nvt 0 " + std::string(uv) + "\nf 1/1 2/2 3/1\n";
    EXPECT_THAT(refusal(write("a.obj", text)), HasSubstr("texture coordinate")) << uv;
  }
}

TEST_F(ObjMesh, PlainMaterialsColourTheirFaces) {
  write("side materials.mtl", sideMaterials());
  const LoadedMesh loaded = loadMesh(write("a.obj", boxObj("mtllib side materials.mtl\nusemtl each\n")));
  test::expectColoredBox(loaded.mesh);
  EXPECT_EQ(loaded.file_colors.painted, 12u);
}

TEST_F(ObjMesh, SeveralLibrariesMayStandInOneLine) {
  write("a.mtl", sideMaterials(0, 2));
  write("b.mtl", sideMaterials(2, 5));
  write("c.mtl", sideMaterials(5, 6));
  test::expectColoredBox(loadMesh(write("a.obj", boxObj("mtllib a.mtl b.mtl\nmtllib c.mtl\nusemtl each\n"))).mesh);
}

TEST_F(ObjMesh, PartlyColouredIsWithoutColour) {
  write("a.mtl", sideMaterials(0, 4) + "newmtl side4\n\nnewmtl side5\n");
  const LoadedMesh loaded = loadMesh(write("a.obj", boxObj("mtllib a.mtl\nusemtl each\n")));
  test::expectPlainBox(loaded.mesh);
  EXPECT_EQ(loaded.file_colors.painted, 8u);
  EXPECT_EQ(loaded.file_colors.none, 4u);
  EXPECT_THAT(loaded.warnings, ElementsAre(HasSubstr("4 of its 12 triangles have no colour")));
}

TEST_F(ObjMesh, VerticesMayHaveColours) {
  for (const double range : {1.0, 255.0}) {
    std::string text;
    const auto corners = test::boxCorners();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Rgb& rgb = test::side_colors[i / 4];
      text += "v";
      for (int axis = 0; axis < 3; ++axis) text += " " + std::to_string(corners[i][axis]);
      for (const int c : {int(rgb.r), int(rgb.g), int(rgb.b)}) text += " " + std::to_string(c / 255.0 * range);
      text += "\n";
    }
    for (int side = 0; side < 6; ++side) {
      text += "f -" + std::to_string(24 - 4 * side) + "//1 -" + std::to_string(23 - 4 * side) + "//1 -" +
              std::to_string(22 - 4 * side) + "//1 -" + std::to_string(21 - 4 * side) + "//1\n";
    }
    test::expectColoredBox(loadMesh(write("a.obj", text)).mesh);
  }
}

TEST_F(ObjMesh, TextIsReadHoweverItIsBroken) {
  writeAtlas();
  write("a.mtl", "\xef\xbb\xbf# made by hand\r\nnewmtl m\rmap_Kd \\\natlas.png\r\n");
  const std::string text = boxObj("# comment\nmtllib a.mtl # the materials\no box\ng one\ns off\nusemtl m\n");
  for (const std::string end : {"\r\n", "\r", " \\\n\n", "\t\n\n"}) {
    std::string other;
    for (const char c : text) other += c == '\n' ? end : std::string(1, c);
    test::expectColoredBox(loadMesh(write("a.obj", other)).mesh);
  }
}

TEST_F(ObjMesh, PolygonsWithDentsAreCutUp) {
  // a U of 0.03 m x 0.03 m without a square of 0.01 m x 0.02 m
  const LoadedMesh loaded =
      loadMesh(write("a.obj",
                     "v 0 0 0\nv 0.03 0 0\nv 0.03 0.03 0\nv 0.02 0.03 0\nv 0.02 0.01 0\nv 0.01 0.01 0\nv 0.01 0.03 0\n"
                     "v 0 0.03 0\nf 1 2 3 4 5 6 7 8\nl 1 2\np 3\n"));
  ASSERT_EQ(loaded.mesh.triangles.size(), 6u);
  double area = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_GT(loaded.mesh.areaVector(i).z(), 0);
    area += double(loaded.mesh.areaVector(i).z());
  }
  EXPECT_NEAR(area, 0.0007, 1e-8);
  EXPECT_THAT(loaded.warnings, ElementsAre(HasSubstr("left out: lines and points (2)")));
}

TEST_F(ObjMesh, DamagedTextIsRefusedByLine) {
  EXPECT_THAT(refusal(write("a.obj", "v 0 0 0\nv 1 x 0\n")), HasSubstr("a.obj': line 2: 'x' is no number"));
  EXPECT_THAT(refusal(write("b.obj", "v 0 0 0\n\nv 1 0\n")), HasSubstr("line 3: a number is missing"));
  EXPECT_THAT(refusal(write("c.obj", "v 0 0 0\nf 1 2 a\n")), HasSubstr("line 2: 'a' is no index"));
  for (const char* face : {"f 1 2 4", "f 1 2 0", "f 1 2 -4", "f 1 2 99999999999", "f 1/5 2 3"}) {
    EXPECT_THAT(refusal(write("d.obj", std::string("v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\n") + face + "\n")),
                HasSubstr("not in the file"));
  }
}

}  // namespace
}  // namespace sks
