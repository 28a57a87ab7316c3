// SPDX-License-Identifier: BSD-3-Clause
// Import of sets with scenes: UniBo and BOP.
#ifdef SKS_EXECUTABLE  // not where the command line is left out of the build

#include <cmath>

#include <gmock/gmock.h>

#include <sks_detector/cloud_io.hpp>

#include "import_fixture.hpp"
#include "io/image_file.hpp"

namespace sks {
namespace {

using test::plyText;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class ImportUnibo : public test::ImportTest {
protected:
  void SetUp() override {
    const std::string view = plyText({{0, 0, 1}, {0.2, 0, 1}, {0, 0.4, 1}});
    for (const char* name : {"mario000", "mario001", "mario010"})
      write("Models/mario/" + std::string(name) + ".ply", view);
    write("Models/bunny.ply", plyText({{0, 0, 0}, {1, 0, 0}, {0, 1, 1}}));
    write("Scenes/scene1.ply", view);
    write("GT/mario000-scene1.xf", "0 -1 0 0.5\n1 0 0 0\n0 0 1 0.25\n0 0 0 1\n");
    write("GT/bunny-scene1.xf", "1 0 0 0 0 1 0 0 0 0 1 2 0 0 0 1");
    writeIni("Models/mario/mario000.ply");
  }
  void writeIni(const std::string& model) const {
    write("Config/scene1.ini",
          "; made on another machine\n[SCENE]\nPATH = \"D:\\data\\Scenes\\scene1.ply\"\n[MODELS]\nNUMBER = 2\n"
          "MODEL_0 = \"../" +
              model +
              "\"\nMODEL_0_GROUNDTRUTH = ../GT/mario000-scene1.xf\n"
              "MODEL_1 = ../Models/bunny.ply\nMODEL_1_GROUNDTRUTH = ../GT/bunny-scene1.xf\n");
    write("Config/detector.ini", "[DETECTOR]\nRADIUS = 3\n");
  }
};

TEST_F(ImportUnibo, TakesPosesAndAllViewsOfAnObject) {
  const DataSet set = imported("unibo", {"--name", "kinect"});
  EXPECT_EQ(set.name, "kinect");
  EXPECT_EQ(set.scale, 1.0);
  EXPECT_EQ(set.max_distance, 0.05);
  ASSERT_EQ(set.training.size(), 4u);
  EXPECT_EQ(set.training[0].object, "bunny");
  EXPECT_EQ(set.training[0].kind, ViewKind::model);
  EXPECT_EQ(set.training[3].object, "mario");
  EXPECT_EQ(set.training[3].kind, ViewKind::view);
  EXPECT_EQ(set.training[3].source, "../download/Models/mario/mario010.ply");

  ASSERT_EQ(set.scenes.size(), 1u);
  EXPECT_EQ(set.scenes[0].name, "scene1");
  ASSERT_EQ(set.scenes[0].objects.size(), 2u);
  const GroundTruth& mario = set.scenes[0].objects[0];
  EXPECT_EQ(mario.object, "mario");
  EXPECT_EQ(mario.reference, "../download/Models/mario/mario000.ply");
  ASSERT_TRUE(mario.T_scene_reference);
  EXPECT_NEAR((*mario.T_scene_reference * Eigen::Vector3d(1, 2, 3) - Eigen::Vector3d(-1.5, 1, 3.25)).norm(), 0, 1e-9);
  EXPECT_NEAR((mario.position - Eigen::Vector3d(0.3, 0.1, 1.25)).norm(), 0, 1e-6);  // of the box centre 0.1, 0.2, 1
  EXPECT_NEAR((set.scenes[0].objects[1].position - Eigen::Vector3d(0.5, 0.5, 2.5)).norm(), 0, 1e-6);
}

TEST_F(ImportUnibo, NamesWhatIsWrong) {
  writeIni("Models/luigi/luigi000.ply");
  EXPECT_THAT(refusal("unibo"),
              AllOf(HasSubstr("scene1.ini: MODELS.MODEL_0 names '../Models/luigi/luigi000.ply', which is nowhere in")));
  writeIni("Models/mario/mario000.ply");
  write("GT/mario000-scene1.xf", "1 0 0 0 0 1");
  EXPECT_THAT(refusal("unibo"), HasSubstr("mario000-scene1.xf: a pose needs 16 numbers, row-major; there are 6"));
  write("GT/mario000-scene1.xf", "2 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1");
  EXPECT_THAT(refusal("unibo"), HasSubstr("its upper left 3 x 3 numbers are no rotation"));
  write("Config/scene1.ini", "[SCENE]\nPATH=../Scenes/scene1.ply\n[MODELS]\nNUMBER=1\nMODEL_0=../Models/bunny.ply\n");
  EXPECT_THAT(refusal("unibo"), HasSubstr("the key MODELS.MODEL_0_GROUNDTRUTH is missing"));
  write("Config/scene1.ini", "");
  EXPECT_THAT(refusal("unibo"), HasSubstr("no .ini file in it names a scene"));
}

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
  EXPECT_THAT(refusal("bop"), HasSubstr("cannot read the depth image"));
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

}  // namespace
}  // namespace sks

#endif
