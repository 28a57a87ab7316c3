// SPDX-License-Identifier: BSD-3-Clause
// Training from files as other programs write them: the codebook, and what it detects in a scene, are those of the
// plain file of the same object.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/cloud_io.hpp>
#include <sks_detector/detector.hpp>

#include "io/dataset.hpp"
#include "simulation/mesh_file.hpp"
#include "simulation/mesh_sampler.hpp"
#include "simulation/notched_box.hpp"
#include "simulation/notched_scene.hpp"

namespace sks {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class TrainingVariants : public test::MeshFileTest {
protected:
  /// A codebook of an object from a file that was written. @param units of the data set @param entry more of its entry
  Codebook trained(const std::string& name, const std::string& units = "m", const std::string& entry = "kind: mesh",
                   DescriptorType type = DescriptorType::automatic) {
    const std::string file =
        write("set.yaml",
              "name: a\nunits: " + units + "\ntraining:\n  - {object: thing, cloud: " + name + ", " + entry + "}\n");
    Settings settings;
    settings.descriptor.type = type;
    warnings_.clear();
    const MeshSampler sampler =
        meshSampler(test::closeViews(), [this](const std::string& w) { warnings_.push_back(w); });
    return train(trainingSamples(loadDataSet(file), sampler), settings, "a");
  }
  Codebook trainedWithColor(const std::string& name) { return trained(name, "m", "kind: mesh", DescriptorType::cshot); }

  static void expectSame(const Codebook& codebook, const Codebook& plain) {
    ASSERT_EQ(codebook.words.size(), plain.words.size());
    for (std::size_t i = 0; i < plain.words.size(); ++i) {
      ASSERT_EQ(codebook.words[i].position, plain.words[i].position) << i;
      ASSERT_EQ(codebook.words[i].frame, plain.words[i].frame) << i;
    }
    ASSERT_EQ(codebook.descriptors.cols(), plain.descriptors.cols());
    const std::size_t levels = plain.words.size() * plain.descriptors.cols();
    EXPECT_EQ(std::memcmp(codebook.descriptors.levels(0), plain.descriptors.levels(0), levels), 0);
    EXPECT_EQ(
        std::memcmp(codebook.descriptors.scales(), plain.descriptors.scales(), sizeof(float) * plain.words.size()), 0);
    ASSERT_EQ(codebook.views.size(), plain.views.size());
    for (std::size_t i = 0; i < plain.views.size(); ++i) {
      EXPECT_EQ(codebook.views[i].surface_points, plain.views[i].surface_points) << i;
      EXPECT_EQ(codebook.views[i].surface_colors, plain.views[i].surface_colors) << i;
    }
  }

  std::vector<std::string> warnings_;
};

std::string withLineEnds(const std::string& text, const std::string& end) {
  std::string result;
  for (const char c : text) result += c == '\n' ? end : std::string(1, c);
  return result;
}

std::string inCapitals(std::string text) {
  for (char& c : text) c = char(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

TEST_F(TrainingVariants, ThePlainFileIsFoundWhereItStands) {
  write("plain.obj", test::notchedObj());
  const Codebook plain = trained("plain.obj");
  EXPECT_EQ(plain.descriptor_type, DescriptorType::shot);
  EXPECT_TRUE(plain.views.at(0).surface_colors.empty());
  EXPECT_TRUE(plain.views.at(0).extent().isApprox(test::box_size, 1e-5f)) << plain.views[0].extent();
  const std::vector<Detection> found = test::detectionsInScene(plain);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].object, "thing");
  test::expectNear(found[0].T_scene_model, test::notchedScene().objects.at(0).T_camera_model, 1e-3, 0.75);
}

TEST_F(TrainingVariants, MeshesWithoutColour) {
  write("plain.obj", test::notchedObj());
  const Codebook plain = trained("plain.obj");
  const std::vector<Detection> expected = test::detectionsInScene(plain);
  ASSERT_EQ(expected.size(), 1u);
  test::NotchedPly little, big, strips;
  little.format = "binary_little_endian";
  big.format = "binary_big_endian";
  strips.strips = true;
  struct Variant {
    const char *name, *units, *entry;
    std::string text;
    const char* warning = "";
    bool rounded = false;  // coordinates differ in the last digit, since the file is not in metres
  };
  const char* const mesh = "kind: mesh";
  const std::vector<Variant> variants = {
      {"no_colour.ply", "m", mesh, test::notchedPly()},
      {"little.ply", "m", mesh, test::notchedPly(little)},
      {"big.ply", "m", mesh, test::notchedPly(big)},
      {"returns.ply", "m", mesh, withLineEnds(test::notchedPly(), "\r")},
      {"strips.ply", "m", mesh, test::notchedPly(strips)},
      {"no_mtl.obj", "m", mesh, test::notchedObj("mtllib gone.mtl\nusemtl m\n"), "'gone.mtl'"},
      {"no_mtllib.obj", "m", mesh, test::notchedObj("usemtl m\n"), "'m'"},
      {"returns.obj", "m", mesh, withLineEnds(test::notchedObj(), "\r\n")},
      {"plain.stl", "m", mesh, test::notchedStl()},
      {"upper.stl", "m", mesh, inCapitals(test::notchedStl())},
      {"mm.dae", "mm", mesh, test::notchedDae("<unit name=\"millimeter\" meter=\"0.001\"/>", 1000), "", true},
      {"mm.obj", "mm", mesh, test::notchedObj("", 1000), "", true},
      {"cm.obj", "m", "kind: mesh, units: cm", test::notchedObj("", 100), "", true},
      {"inch.stl", "mm", "kind: mesh, units: inch", test::notchedStl(1 / 0.0254), "", true},
  };
  for (const Variant& variant : variants) {
    SCOPED_TRACE(variant.name);
    write(variant.name, variant.text);
    const Codebook codebook = trained(variant.name, variant.units, variant.entry);
    EXPECT_EQ(codebook.descriptor_type, DescriptorType::shot);
    EXPECT_TRUE(codebook.views.at(0).surface_colors.empty());
    EXPECT_TRUE(codebook.views[0].extent().isApprox(test::box_size, 1e-5f)) << codebook.views[0].extent();
    if (*variant.warning == 0) {
      EXPECT_THAT(warnings_, IsEmpty());
    } else {
      EXPECT_THAT(warnings_, ::testing::Contains(HasSubstr(variant.warning)));
    }
    if (!variant.rounded) expectSame(codebook, plain);
    test::expectSameDetections(test::detectionsInScene(codebook), expected, variant.rounded);
  }
}

TEST_F(TrainingVariants, AScaleOfTheCommandLine) {
  write("plain.obj", test::notchedObj());
  const std::vector<Detection> expected = test::detectionsInScene(trained("plain.obj"));
  const LoadedMesh loaded = loadMesh(write("cm.obj", test::notchedObj("", 100)), 0.01);
  EXPECT_TRUE(loaded.mesh.box().sizes().isApprox(test::box_size, 1e-5f));
  const Codebook codebook =
      train(meshSamples("thing", "cm.obj", std::make_shared<Mesh>(loaded.mesh), test::closeViews()), {}, "a");
  test::expectSameDetections(test::detectionsInScene(codebook), expected, true);
}

TEST_F(TrainingVariants, ColoursByManyNamesAndTypes) {
  test::NotchedPly plain_ply;
  plain_ply.colors = {"red", "green", "blue"};
  write("plain.ply", test::notchedPly(plain_ply));
  const Codebook plain = trainedWithColor("plain.ply");
  ASSERT_FALSE(plain.views.at(0).surface_colors.empty());
  const std::vector<Detection> expected = test::detectionsInScene(plain);
  ASSERT_EQ(expected.size(), 1u);
  test::expectNear(expected[0].T_scene_model, test::notchedScene().objects.at(0).T_camera_model, 1e-3, 0.75);
  test::NotchedPly diffuse, letters, floats, words;
  diffuse.colors = {"diffuse_red", "diffuse_green", "diffuse_blue"};
  letters.colors = {"r", "g", "b"};
  letters.format = "binary_little_endian";
  floats = words = plain_ply;
  floats.type = "float";
  floats.range = 1;
  words.type = "ushort";
  words.range = 65535;
  words.format = "binary_big_endian";
  for (const test::NotchedPly& with : {diffuse, letters, floats, words}) {
    SCOPED_TRACE(with.colors[0] + (" " + with.type));
    write("variant.ply", test::notchedPly(with));
    const Codebook codebook = trainedWithColor("variant.ply");
    EXPECT_THAT(warnings_, IsEmpty());
    expectSame(codebook, plain);
    test::expectSameDetections(test::detectionsInScene(codebook), expected);
  }
}

TEST_F(TrainingVariants, ColoursOfPictures) {
  write("atlas.png", encodePng(test::boxAtlas()));
  write("a.mtl", "newmtl m\nmap_Kd atlas.png\n");
  write("plain.obj", test::notchedObj("mtllib a.mtl\nusemtl m\n"));
  const Codebook plain = trainedWithColor("plain.obj");
  ASSERT_FALSE(plain.views.at(0).surface_colors.empty());
  const std::vector<Detection> expected = test::detectionsInScene(plain);
  ASSERT_EQ(expected.size(), 1u);
  for (const char* format : {"ascii", "binary_little_endian"}) {
    SCOPED_TRACE(format);
    test::NotchedPly with;
    with.format = format;
    with.face_texture = true;
    write("variant.ply", test::notchedPly(with));
    const Codebook codebook = trainedWithColor("variant.ply");
    EXPECT_THAT(warnings_, IsEmpty());
    expectSame(codebook, plain);
    test::expectSameDetections(test::detectionsInScene(codebook), expected);
  }
}

TEST_F(TrainingVariants, Clouds) {
  const Cloud view = test::notchedView();
  writeCloud(folder_.path("plain.pcd"), view);
  const Codebook plain = trained("plain.pcd", "m", "kind: view");
  const std::vector<Detection> expected = test::detectionsInScene(plain);
  ASSERT_EQ(expected.size(), 1u);
  std::string pcd = "VERSION .7\nFIELDS x y z r g b\nSIZE 4 4 4 1 1 1\nTYPE F F F U U U\nCOUNT 1 1 1 1 1 1\nWIDTH " +
                    std::to_string(view.width) + "\nHEIGHT " + std::to_string(view.height) + "\nPOINTS " +
                    std::to_string(view.size()) + "\nDATA ascii\n";
  std::string points;
  std::size_t measured = 0;
  for (std::size_t i = 0; i < view.size(); ++i) {
    char text[160];
    const Eigen::Vector3f& p = view.points[i];
    const Rgb& c = view.colors[i];
    const bool is_there = p.allFinite();
    std::snprintf(text, sizeof(text), "%.9g %.9g %.9g %d %d %d\n", double(p.x()), double(p.y()), double(p.z()),
                  int(c.r), int(c.g), int(c.b));
    pcd += is_there ? text : "1.#QNAN 1.#QNAN -1.#IND 0 0 0\n";
    points += is_there ? text : "nan nan nan 0 0 0\n";
    measured += is_there ? 1 : 0;
  }
  EXPECT_LT(measured, view.size());  // there are words for no number
  const std::string ply = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(view.size()) +
                          "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar diffuse_red\n"
                          "property uchar diffuse_green\nproperty uchar diffuse_blue\nend_header\n" +
                          points;
  write("words.pcd", pcd);
  write("returns.ply", withLineEnds(ply, "\r"));
  for (const char* name : {"words.pcd", "returns.ply"}) {
    SCOPED_TRACE(name);
    const Codebook codebook = trained(name, "m", "kind: view");
    EXPECT_EQ(codebook.descriptor_type, plain.descriptor_type);
    if (std::string(name) == "words.pcd") expectSame(codebook, plain);  // a PLY file is not organised
    const std::vector<Detection> found = test::detectionsInScene(codebook);
    ASSERT_EQ(found.size(), 1u);
    if (std::string(name) == "words.pcd") test::expectSameDetections(found, expected);
    test::expectNear(found[0].T_scene_model, expected[0].T_scene_model, 0.003, 2);
  }
}

}  // namespace
}  // namespace sks
