// SPDX-License-Identifier: BSD-3-Clause
// Import of sets with scenes: UniBo.
#ifdef SKS_EXECUTABLE  // not where the command line is left out of the build

#include <cmath>

#include <gmock/gmock.h>

#include <sks_detector/cloud_io.hpp>

#include "import_fixture.hpp"

namespace sks {
namespace {

using test::plyText;
using ::testing::AllOf;
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

}  // namespace
}  // namespace sks

#endif
