// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/simulation/mesh.hpp>

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.hpp"
#include "io/image_file.hpp"
#include "simulation/shapes.hpp"
#include "temporary_folder.hpp"

namespace sks {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class MeshFile : public ::testing::Test {
protected:
  std::string write(const std::string& name, const std::string& content) const {
    test::writeFile(folder_.path(name), content);
    return folder_.path(name);
  }
  std::string refusal(const std::string& path) const {
    return test::errorOf(ErrorCode::bad_file, [&] { loadMesh(path); });
  }

  test::TemporaryFolder folder_;
};

const std::string triangle = "v 0 0 0\nv 0.2 0 0\nv 0 0.1 0\nf 1 2 3\n";

bool sameColor(const Rgb& a, const Rgb& b) {
  return a.r == b.r && a.g == b.g && a.b == b.b;
}

TEST_F(MeshFile, ObjIsReadInMetres) {
  const LoadedMesh loaded = loadMesh(write("a.obj", triangle));
  EXPECT_THAT(loaded.warnings, IsEmpty());
  EXPECT_EQ(loaded.mesh.triangles.size(), 1u);
  EXPECT_FALSE(loaded.mesh.hasColor());
  EXPECT_TRUE(loaded.mesh.box().max().isApprox(Eigen::Vector3f(0.2f, 0.1f, 0)));
  EXPECT_NEAR(loaded.mesh.areaVector(0).z(), 0.01f, 1e-7f);
}

TEST_F(MeshFile, OtherFormatsAreNotTried) {
  EXPECT_THAT(refusal(write("a.blend", triangle)), HasSubstr("not called like an OBJ, PLY, STL, DAE or glTF file"));
  EXPECT_EQ(loadMesh(write("A.OBJ", triangle)).mesh.triangles.size(), 1u);
}

TEST_F(MeshFile, CutOffPlyHeadersAreRefused) {
  const std::string header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n";
  EXPECT_THAT(refusal(write("a.ply", header)), HasSubstr("has no line end_header"));
  EXPECT_THAT(refusal(write("b.ply", header + "prope2\n")), HasSubstr("has no line end_header"));
  EXPECT_THAT(refusal(write("c.ply", header + "end_header\v0 0 1\n")), HasSubstr("c.ply': it is truncated"));
  EXPECT_THAT(refusal(write("d.ply", header + "properWty float y\nend_header\n")), HasSubstr("d.ply': "));
  EXPECT_THAT(refusal(write("e.ply", "plx" + header)), HasSubstr("it is no PLY file"));
}

TEST_F(MeshFile, TextureGivesColour) {
  ColorImage image(2, 2, {255, 0, 0});
  image(0, 1) = image(1, 1) = {0, 0, 255};  // left red, right blue
  write("t.png", encodePng(image));
  write("a.mtl", "newmtl m\nmap_Kd t.png \n");
  const Mesh mesh = loadMesh(write("a.obj",
                                   "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.25 0.5\nvt 0.75 0.5\n"
                                   "vt 0.25 0.5\nf 1/1 2/2 3/3\n"))
                        .mesh;
  ASSERT_TRUE(mesh.hasColor());
  EXPECT_TRUE(sameColor(mesh.color(0, 0, 0, 0), {255, 0, 0}));
  EXPECT_TRUE(sameColor(mesh.color(0, 1, 0, 0), {0, 0, 255}));
  EXPECT_TRUE(sameColor(mesh.color(0, 0.5f, 0, 0), {128, 0, 128}));
}

TEST_F(MeshFile, DaeKeepsItsAxesAndItsUnit) {
  const Mesh mesh = loadMesh(write("a.dae", R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="millimeter" meter="0.001"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="9">0 0 0 300 0 0 0 200 100</float_array><technique_common>
<accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"/></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)"))
                        .mesh;
  EXPECT_TRUE(mesh.box().max().isApprox(Eigen::Vector3f(0.3f, 0.2f, 0.1f))) << mesh.box().max().transpose();
}

TEST_F(MeshFile, RefusesWhatCannotBeUsed) {
  EXPECT_THAT(refusal(folder_.path("gone.obj")), HasSubstr("gone.obj': it does not exist"));
  EXPECT_THAT(refusal(folder_.path()), HasSubstr("it is a folder; give the name of a mesh file"));
  EXPECT_THAT(refusal(write("points.ply",
                            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                            "property float z\nend_header\n0 0 0\n")),
              HasSubstr("points.ply': "));
  const std::string unfinished =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_THAT(refusal(write("corners.ply", unfinished + "0\n")), HasSubstr("corners.ply': it has no triangles"));
  for (const char* face : {"3 0 1 3\n", "3 0 1 60000000\n", "3 0 1 -1\n"}) {
    EXPECT_THAT(refusal(write("index.ply", unfinished + face)),
                HasSubstr("index.ply': it has a face with a vertex that is not in the file; copy it again"));
  }
  EXPECT_EQ(loadMesh(write("whole.ply", unfinished + "3 0 1 2\n")).mesh.triangles.size(), 1u);
  EXPECT_THAT(refusal(write("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")), HasSubstr("not finite"));
  EXPECT_THAT(refusal(write("huge.obj", "v 0 0 0\nv 1e30 0 0\nv 0 1 0\nf 1 2 3\n")),
              HasSubstr("farther than a billion units away"));
  EXPECT_THAT(refusal(write("flat.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n")), HasSubstr("flat.obj': "));
  EXPECT_THAT(refusal(write("text.obj", "hello\n")), HasSubstr("text.obj': "));
  EXPECT_THAT(refusal(write("foreign.xyz", "1 2 3\n")), HasSubstr("foreign.xyz': "));
}

/// Whatever the coordinates are, no pixel outside of the picture is read.
TEST(Texture, TakesAnyCoordinates) {
  const Texture texture(3, 2, {{10, 0, 0}, {20, 0, 0}, {30, 0, 0}, {40, 0, 0}, {50, 0, 0}, {60, 0, 0}});
  const float largest = std::numeric_limits<float>::max(), inf = std::numeric_limits<float>::infinity();
  for (const float u : {0.0f, 1.0f, -1e-12f, 1e7f, -3e9f, largest, -largest, inf, -inf, std::nanf("")}) {
    for (const float v : {0.5f, u}) {
      for (const float footprint : {0.0f, 2.0f, largest, inf, -inf, std::nanf("")}) {
        const Rgb color = texture.at(u, v, footprint);
        EXPECT_GE(color.r, 10) << u << " " << v << " " << footprint;
        EXPECT_LE(color.r, 60) << u << " " << v << " " << footprint;
      }
    }
  }
}

TEST(Texture, TakesTheMeanOfWhatAPixelSees) {
  std::vector<Rgb> pixels;
  for (int i = 0; i < 64; ++i) pixels.push_back((i + i / 8) % 2 ? Rgb{200, 100, 0} : Rgb{0, 100, 200});
  const Texture checkers(8, 8, pixels);
  EXPECT_TRUE(sameColor(checkers.at(0.5f / 8, 1 - 0.5f / 8), {0, 100, 200}));
  EXPECT_TRUE(sameColor(checkers.at(1.5f / 8, 1 - 0.5f / 8), {200, 100, 0}));
  EXPECT_TRUE(sameColor(checkers.at(0.5f / 8, 1 - 0.5f / 8, 2), {100, 100, 100}));
  EXPECT_TRUE(sameColor(checkers.at(0.3f, 0.7f, 1000), {100, 100, 100}));
  EXPECT_THAT(test::errorOf(ErrorCode::bad_data, [] { Texture(2, 2, {}); }), HasSubstr("2 x 2"));
}

TEST(Shapes, HaveTheirMeasures) {
  const Mesh box = makeBox({0.1f, 0.2f, 0.3f}, plain({}), 0.05f);
  EXPECT_TRUE(box.box().sizes().isApprox(Eigen::Vector3f(0.1f, 0.2f, 0.3f)));
  const auto area = [](const Mesh& mesh) {
    double sum = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) sum += mesh.areaVector(i).norm();
    return sum;
  };
  EXPECT_NEAR(area(box), 2 * (0.02 + 0.03 + 0.06), 1e-6);
  EXPECT_NEAR(area(makeSphere(0.1f, 5, plain({}))), 4 * EIGEN_PI * 0.01, 1e-4);
  EXPECT_NEAR(area(makeRevolution({{0.1f, 0}, {0.1f, 0.2f}}, 256, plain({}))), 2 * EIGEN_PI * 0.1 * 0.2, 1e-4);
  const Mesh tube = makeTube({{0, 0, 0}, {0, 0, 0.1f}, {0, 0, 0.2f}}, {0.02f, 0.02f, 0.02f}, 64, plain({}));
  EXPECT_NEAR(area(tube), 2 * EIGEN_PI * 0.02 * 0.2 + 2 * EIGEN_PI * 0.0004, 1e-4);
}

TEST(Shapes, DirectionsAreSpreadEvenly) {
  for (const int count : {12, 20, 42, 100, 162}) {
    const auto directions = geodesicDirections(count);
    ASSERT_EQ(directions.size(), std::size_t(count));
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& d : directions) {
      EXPECT_NEAR(d.norm(), 1, 1e-9);
      sum += d;
    }
    EXPECT_LT(sum.norm() / count, 0.02) << count;
  }
}

}  // namespace
}  // namespace sks
