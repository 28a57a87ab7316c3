// SPDX-License-Identifier: BSD-3-Clause
// Import of sets of the BOP challenge, as they are published and as downloads leave them.
#ifdef SKS_EXECUTABLE  // not where the command line is left out of the build

#include <algorithm>
#include <cmath>
#include <future>
#include <vector>

#include <gmock/gmock.h>

#include <sks_detector/cloud_io.hpp>

#include "import_fixture.hpp"
#include "io/file.hpp"
#include "io/image_file.hpp"

namespace sks {
namespace {

using test::plyText;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class ImportBop : public test::ImportTest {
protected:
  void SetUp() override {
    write("models/obj_000001.ply", plyText({{-10, -20, 0}, {10, -20, 0}, {10, 20, 60}}));
    write("models/obj_000005.ply", plyText({{0, 0, 0}, {10, 0, 0}, {0, 10, 10}}));
    write("models/models_info.json",
          R"({"1": {"diameter": 70, "symmetries_continuous": [{"axis": [0, 0, 1], "offset": [0, 0, 0]}]},
              "5": {"diameter": 17, "symmetries_discrete": [[-1,0,0,0, 0,-1,0,0, 0,0,1,0, 0,0,0,1]]}})");
    write("test/000002/scene_camera.json", R"({"3": {"cam_K": [100, 0, 2, 0, 200, 1, 0, 0, 1], "depth_scale": 0.1}})");
    writeTruth("[0, -1, 0, 1, 0, 0, 0, 0, 1]");
    write("test/000002/scene_gt_info.json", R"({"3": [{"visib_fract": 0.75}, {"visib_fract": 0.02}]})");
    DepthImage depth(4, 3);
    depth(1, 2) = 8000;
    depth(2, 3) = 10000;
    write("test/000002/depth/000003.png", encodePng(depth));
    write("test/000002/rgb/000003.png", encodePng(ColorImage(4, 3, {30, 20, 10})));
  }
  void addImage(int id) const {
    const std::string name = (id < 10 ? "00000" : "0000") + std::to_string(id) + ".png";
    write("test/000002/depth/" + name, encodePng(DepthImage(4, 3, 8000)));
    write("test/000002/rgb/" + name, encodePng(ColorImage(4, 3, {30, 20, 10})));
  }
  /// Lists images of which addImage() makes some.
  void listImages(const std::vector<int>& ids) const {
    std::string cameras;
    for (const int id : ids) {
      cameras += (cameras.empty() ? "" : ", ") + ("\"" + std::to_string(id)) +
                 R"(": {"cam_K": [100, 0, 2, 0, 200, 1, 0, 0, 1], "depth_scale": 0.1})";
    }
    write("test/000002/scene_camera.json", "{" + cameras + "}");
  }
  void writeTruth(const std::string& rotation) const {
    write("test/000002/scene_gt.json",
          R"({"3": [{"obj_id": 1, "cam_R_m2c": )" + rotation +
              R"(, "cam_t_m2c": [1, 2, 800]}, {"obj_id": 5, "cam_R_m2c": [1, 0, 0, 0, 1, 0, 0, 0, 1],
                 "cam_t_m2c": [0, 0, 900]}]})");
  }
};

TEST_F(ImportBop, TakesModelsPosesAndVisibility) {
  const DataSet set = imported("bop");
  EXPECT_EQ(set.scale, 0.001);
  EXPECT_EQ(set.max_distance, 0.05);
  ASSERT_EQ(set.training.size(), 2u);
  EXPECT_EQ(set.training[0].object, "obj_000001");
  EXPECT_TRUE(set.training[0].mesh);
  EXPECT_EQ(set.training[0].source, "../download/models/obj_000001.ply");
  ASSERT_TRUE(set.training[0].symmetry && set.training[1].symmetry);
  EXPECT_EQ(set.training[0].symmetry->order, 0);
  EXPECT_EQ(set.training[1].symmetry->order, 2);
  EXPECT_NEAR(std::abs(set.training[1].symmetry->axis.z()), 1, 1e-6);

  EXPECT_NEAR(*set.training[0].diameter, 0.070, 1e-12);
  EXPECT_NEAR(*set.training[1].diameter, 0.017, 1e-12);

  ASSERT_EQ(set.scenes.size(), 1u);
  const Scene& scene = set.scenes[0];
  EXPECT_EQ(scene.name, "000002/000003");
  ASSERT_EQ(scene.objects.size(), 1u);
  EXPECT_EQ(scene.objects[0].object, "obj_000001");
  EXPECT_EQ(scene.objects[0].reference, set.training[0].source);
  EXPECT_EQ(scene.objects[0].visibility, 0.75);
  // the box centre 0, 0, 30 mm, turned and moved
  EXPECT_NEAR((scene.objects[0].position - Eigen::Vector3d(0.001, 0.002, 0.830)).norm(), 0, 1e-9);
  EXPECT_NEAR(
      (*scene.objects[0].T_scene_reference * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(0.001, 1.002, 0.8)).norm(), 0,
      1e-9);
  EXPECT_THAT(scene.ignore, ElementsAre("obj_000005"));
}

TEST_F(ImportBop, KeepsEverySymmetry) {
  write("models/models_info.json",
        R"({"1": {"diameter": 70,
                  "symmetries_discrete": [[1,0,0,0, 0,-1,0,4, 0,0,-1,60, 0,0,0,1], [-1,0,0,0, 0,1,0,0, 0,0,-1,60, 0,0,0,1]],
                  "symmetries_continuous": [{"axis": [0, 0, 1], "offset": [1, 2, 0]}]},
            "5": {"diameter": 17,
                  "symmetries_discrete": [[1,0,0,0, 0,-1,0,0, 0,0,-1,0, 0,0,0,1], [-1,0,0,0, 0,1,0,0, 0,0,-1,0, 0,0,0,1]]}})");
  const DataSet set = imported("bop");
  ASSERT_TRUE(set.training[0].symmetries && set.training[1].symmetries);
  const ObjectSymmetries& both = *set.training[0].symmetries;
  ASSERT_EQ(both.discrete.size(), 2u);
  const Eigen::Vector3d moved = both.discrete[0] * Eigen::Vector3d(0.001, 0.001, 0.001);
  EXPECT_NEAR((moved - Eigen::Vector3d(0.001, 0.003, 0.059)).norm(), 0, 1e-9);
  ASSERT_EQ(both.continuous.size(), 1u);
  EXPECT_NEAR((both.continuous[0].position - Eigen::Vector3d(0.001, 0.002, 0)).norm(), 0, 1e-12);
  EXPECT_EQ(set.training[1].symmetries->discrete.size(), 2u);
  EXPECT_FALSE(set.training[1].symmetry);  // not about one axis: training has no word for it
}

TEST_F(ImportBop, SymmetriesThatAreNoneAreRefused) {
  write("models/models_info.json", R"({"1": {"symmetries_discrete": [[2,0,0,0, 0,2,0,0, 0,0,2,0, 0,0,0,1]]}})");
  EXPECT_THAT(refusal("bop"), HasSubstr("models_info.json: object 1, symmetries_discrete: is scaled by 2"));
  write("models/models_info.json", R"({"1": {"symmetries_continuous": [{"offset": [0, 0, 0]}]}})");
  EXPECT_THAT(refusal("bop"), HasSubstr("object 1, symmetries_continuous: the key 'axis' is missing"));
}

TEST_F(ImportBop, TurnsDepthIntoOrganisedCloudsInMillimetres) {
  const DataSet set = imported("bop");
  const Cloud cloud = readCloud(set.scenes.at(0).path, set.scale);
  EXPECT_EQ(cloud.width, 4u);
  EXPECT_EQ(cloud.height, 3u);
  EXPECT_TRUE(std::isnan(cloud.points[0].z()));
  EXPECT_NEAR((cloud.points[4 + 2] - Eigen::Vector3f(0, 0, 0.8f)).norm(), 0, 1e-6);
  EXPECT_NEAR((cloud.points[8 + 3] - Eigen::Vector3f(0.01f, 0.005f, 1)).norm(), 0, 1e-6);
  ASSERT_TRUE(cloud.hasColor());
  EXPECT_EQ(int(cloud.colors[6].r), 30);
  EXPECT_EQ(int(cloud.colors[6].b), 10);
}

TEST_F(ImportBop, NamesWhatIsWrong) {
  writeTruth("[1, 0, 0]");
  EXPECT_THAT(refusal("bop"), HasSubstr("scene_gt.json: image 3, object 0, cam_R_m2c: must be a list of 9 numbers"));
  writeTruth("[1, 0, 0, 0, 1, 0, 0, 0, 1]");
  EXPECT_THAT(refusal("bop", {"--split", "val"}), HasSubstr("has no folder val with scenes; there is test"));
  write("test/000002/depth/000003.png", encodePng(ColorImage(4, 3)));
  EXPECT_THAT(refusal("bop"), HasSubstr("000003.png': a depth image must have one channel of 16 bits"));
  std::filesystem::remove(place("test/000002/depth/000003.png"));
  EXPECT_THAT(refusal("bop"), HasSubstr("has no scenes with images: none of the 1 that its scene_camera.json list"));
  addImage(3);
  write("test/000002/scene_camera.json", R"({"3": {"cam_K": [1, 0, 0, 0, 1, 0, 0, 0, 1]}})");
  EXPECT_THAT(refusal("bop"), HasSubstr("scene_camera.json: image 3: the key 'depth_scale' is missing"));
  write("test/000002/scene_camera.json", "{");
  EXPECT_THAT(refusal("bop"), HasSubstr("scene_camera.json: not a JSON file"));
  std::filesystem::remove(place("models/obj_000005.ply"));
  SetUp();
  std::filesystem::remove(place("models/obj_000005.ply"));
  EXPECT_THAT(refusal("bop"), HasSubstr("image 3 has object 5, but there is no models/obj_000005.ply"));
  std::filesystem::remove_all(folder_.path("download/models"));
  EXPECT_THAT(refusal("bop"), HasSubstr("has no folder 'models'"));
}

TEST_F(ImportBop, RotationsThatAreNearlyOnesBecomeTheNearest) {
  writeTruth("[0.004, -1.003, 0, 0.998, 0.002, 0, 0, 0, 1.004]");  // as published: orthonormal to 0.01
  const DataSet set = imported("bop");
  const Eigen::Matrix3d R = set.scenes.at(0).objects.at(0).T_scene_reference->linear();
  EXPECT_LT((R.transpose() * R - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_NEAR(R(0, 1), -1, 1e-4);

  writeTruth("[0, -1.03, 0, 1, 0, 0, 0, 0, 1]");
  const test::CommandRun run = import("bop", {"--force"});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.errors,
              HasSubstr("scene_gt.json: image 3, object 0: cam_R_m2c is orthonormal to 0.061 only; the nearest "
                        "rotation is written"));
  EXPECT_EQ(std::count(run.errors.begin(), run.errors.end(), '\n'), 1) << run.errors;
  EXPECT_NEAR(loadDataSet(output()).scenes.at(0).objects.at(0).T_scene_reference->linear()(0, 1), -1, 1e-9);
}

TEST_F(ImportBop, WhatIsNoRotationIsRefusedWithFileAndEntry) {
  for (const auto& [rotation, reason] : std::vector<std::pair<std::string, std::string>>{
           {"[0, -2, 0, 2, 0, 0, 0, 0, 2]", "is scaled by 2"},
           {"[0, -0.001, 0, 0.001, 0, 0, 0, 0, 0.001]", "is scaled by 0.001"},
           {"[0, 1, 0, 1, 0, 0, 0, 0, 1]", "is a reflection"},
           {"[1, 0, 0, 0, 1, 0, 0, 0, -1]", "is a reflection"},
           {"[1, 0.5, 0, 0, 1, 0, 0, 0, 1]", "is no rotation"},
           {"[0, 0, 0, 0, 0, 0, 0, 0, 0]", "is no rotation"}}) {
    writeTruth(rotation);
    EXPECT_THAT(refusal("bop"), HasSubstr("scene_gt.json: image 3, object 0, cam_R_m2c: " + reason)) << rotation;
  }
}

TEST_F(ImportBop, TakesWhatIsThereOfAnIncompleteDownload) {
  listImages({3, 4, 5, 6, 12});
  addImage(5);
  addImage(12);
  std::filesystem::remove(place("test/000002/rgb/000012.png"));
  std::filesystem::create_directories(folder_.path("download/test/000007"));
  const test::CommandRun run = import("bop");
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.errors, HasSubstr("3 of 5 images were left out: their depth or rgb picture is not there"));
  EXPECT_THAT(run.errors, HasSubstr("left out, since they have no scene_camera.json: 000007"));
  const DataSet set = loadDataSet(output());
  ASSERT_EQ(set.scenes.size(), 2u);
  EXPECT_EQ(set.scenes[0].name, "000002/000003");
  EXPECT_EQ(set.scenes[1].name, "000002/000005");
  for (const Scene& scene : set.scenes) EXPECT_TRUE(readCloud(scene.path).hasColor());
  for (const char* file : {"test/000002/depth/000003.png", "test/000002/depth/000005.png"})
    std::filesystem::remove(place(file));
  EXPECT_THAT(import("bop", {"--force"}).errors, HasSubstr("none of the 5 that its scene_camera.json list is there"));
}

TEST_F(ImportBop, PicturesThatCannotBeReadAreNamed) {
  const auto refusedFor = [&](const std::string& name) { return AllOf(HasSubstr(name), HasSubstr("cannot read")); };
  write("test/000002/rgb/000003.png", "no picture");
  EXPECT_THAT(refusal("bop"), refusedFor("rgb/000003.png"));
  write("test/000002/rgb/000003.png", "");
  EXPECT_THAT(refusal("bop"), refusedFor("rgb/000003.png"));
  std::filesystem::remove(place("test/000002/rgb/000003.png"));
  std::filesystem::create_symlink("nowhere.png", place("test/000002/rgb/000003.png"));
  EXPECT_THAT(refusal("bop"), refusedFor("rgb/000003.png"));
  std::filesystem::remove(place("test/000002/rgb/000003.png"));
  std::filesystem::create_directory(place("test/000002/rgb/000003.jpg"));
  EXPECT_THAT(refusal("bop"), refusedFor("rgb/000003.jpg"));
  std::filesystem::remove(place("test/000002/rgb/000003.jpg"));
  write("test/000002/rgb/000003.tif", std::string("II*\0abc", 7));
  EXPECT_THAT(refusal("bop"), HasSubstr("rgb/000003.tif': it is a TIFF file: convert it to PNG"));
}

TEST_F(ImportBop, SetsWithoutColourOrTruthAreImportedWithAWord) {
  std::filesystem::remove_all(folder_.path("download/test/000002/rgb"));
  std::filesystem::remove(place("test/000002/scene_gt.json"));
  const test::CommandRun run = import("bop");
  ASSERT_EQ(run.status, 0) << run.errors;
  EXPECT_THAT(run.errors, HasSubstr("1 of 1 images have no colour, since there is no folder rgb"));
  EXPECT_THAT(run.errors, HasSubstr("1 of 1 images are without truth (scene_gt.json)"));
  const DataSet set = loadDataSet(output());
  ASSERT_EQ(set.scenes.size(), 1u);
  EXPECT_TRUE(set.scenes[0].objects.empty());
  EXPECT_THAT(set.scenes[0].ignore, ElementsAre("obj_000001", "obj_000005"));  // what is found there counts neither way
  EXPECT_FALSE(readCloud(set.scenes[0].path).hasColor());
}

TEST_F(ImportBop, TheFolderOfMeshesCanBeChosen) {
  std::filesystem::rename(folder_.path("download/models"), folder_.path("download/models_cad"));
  std::filesystem::create_directory(folder_.path("download/models_reconst"));
  const test::CommandRun run = import("bop");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.errors,
              HasSubstr("has no folder 'models'; there is models_cad, models_reconst: choose by --models NAME"));
  const DataSet set = imported("bop", {"--models", "models_cad"});
  EXPECT_EQ(set.training.at(0).source, "../download/models_cad/obj_000001.ply");
  EXPECT_EQ(set.scenes.at(0).objects.at(0).reference, set.training[0].source);
  EXPECT_TRUE(set.training[0].symmetry);
}

TEST_F(ImportBop, ReplacesNoDataSetUnasked) {
  imported("bop");
  const std::string before = readTextFile(output());
  const test::CommandRun refused = import("bop", {"--name", "other"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.errors, HasSubstr("set.yaml' is there already: give another one, or --force"));
  EXPECT_EQ(readTextFile(output()), before);
  EXPECT_EQ(imported("bop", {"--name", "other", "--force"}).name, "other");
}

TEST_F(ImportBop, OfTwoAtOnceOneAloneWrites) {
  for (int round = 0; round < 5; ++round) {
    std::vector<std::future<test::CommandRun>> running;
    for (const char* name : {"one", "other"}) {
      running.push_back(std::async(std::launch::async, [&, name] { return import("bop", {"--name", name}); }));
    }
    const test::CommandRun runs[] = {running[0].get(), running[1].get()};
    const int winner = runs[0].status == 0 ? 0 : 1;
    EXPECT_EQ(runs[winner].status, 0) << runs[winner].errors;
    EXPECT_EQ(runs[1 - winner].status, 2);
    EXPECT_THAT(runs[1 - winner].errors, HasSubstr("set.yaml' is there already: give another one, or --force"));
    EXPECT_EQ(loadDataSet(output()).name, winner == 0 ? "one" : "other");
    std::filesystem::remove(output());
  }
}

}  // namespace
}  // namespace sks

#endif
