// SPDX-License-Identifier: BSD-3-Clause
// Import of classification sets: ModelNet, Princeton Shape Benchmark, Washington RGB-D, BigBIRD.
#ifdef SKS_EXECUTABLE  // not where the command line is left out of the build

#include <algorithm>

#include <gmock/gmock.h>

#include <sks_detector/cloud_io.hpp>

#include "import_fixture.hpp"

namespace sks {
namespace {

using test::offBox;
using test::pcdText;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

using ImportModelNet = test::ImportTest;
using ImportPrinceton = test::ImportTest;
using ImportWashington = test::ImportTest;
using ImportBigBird = test::ImportTest;

Eigen::AlignedBox3f boxOf(const Cloud& cloud) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& point : cloud.points) box.extend(point);
  return box;
}

/// Lines that end with CR alone.
std::string withReturns(std::string text) {
  std::replace(text.begin(), text.end(), '\n', '\r');
  return text;
}

TEST_F(ImportModelNet, SamplesMeshesOfTrainAndTest) {
  write("chair/train/chair_0001.off", offBox("OFF\n# a comment\n8 6 12", 30, 40, 120));
  write("chair/test/chair_0002.off", offBox("OFF8 6 12", 1, 1, 1));  // the broken head of ModelNet
  write("sofa/train/sofa_0001.off", withReturns(offBox("OFF 8 6 12", 2, 1, 1)));
  write("README.txt", "");
  const DataSet set = imported("modelnet", {"--points", "2000", "--diagonal", "0.26"});
  EXPECT_EQ(set.name, "download");
  ASSERT_EQ(set.training.size(), 2u);
  EXPECT_EQ(set.training[0].object, "chair");
  EXPECT_EQ(set.training[0].kind, ViewKind::model);
  EXPECT_EQ(set.training[0].source, "set_clouds/train/chair_0001.pcd");
  EXPECT_EQ(set.training[1].object, "sofa");
  ASSERT_EQ(set.tests.size(), 1u);
  EXPECT_EQ(set.tests[0].object, "chair");

  const Cloud cloud = readCloud(set.training[0].path);
  EXPECT_EQ(cloud.size(), 2000u);
  const Eigen::AlignedBox3f box = boxOf(cloud);
  EXPECT_NEAR(box.diagonal().norm(), 0.26, 1e-5);
  EXPECT_NEAR(box.center().norm(), 0, 1e-5);
  EXPECT_NEAR(box.sizes().x(), 0.06, 1e-3);  // 30 : 40 : 120 has the diagonal 130
  EXPECT_NEAR(box.sizes().z(), 0.24, 1e-3);
  const auto on_surface = [&](const Eigen::Vector3f& p) {
    return ((p - box.min()).cwiseAbs().minCoeff() < 1e-3f) || ((p - box.max()).cwiseAbs().minCoeff() < 1e-3f);
  };
  EXPECT_TRUE(std::all_of(cloud.points.begin(), cloud.points.end(), on_surface));
  const auto top = std::count_if(cloud.points.begin(), cloud.points.end(),
                                 [&](const Eigen::Vector3f& p) { return box.max().z() - p.z() < 1e-4f; });
  EXPECT_NEAR(double(top) / 2000, 1200.0 / 19200, 0.01);  // as its share of the area
}

TEST_F(ImportModelNet, NamesWhatIsWrong) {
  EXPECT_THAT(refusal("modelnet"), HasSubstr("is not ModelNet: there is no <class>/train/*.off in it"));
  write("chair/train/a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n");
  EXPECT_THAT(refusal("modelnet"), AllOf(HasSubstr("a.off:4: the file ends where vertex 3 of 3 should be")));
  write("chair/train/a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n");
  EXPECT_THAT(refusal("modelnet"), HasSubstr("a.off:6: face 1 of 1 names vertex 7, which is not there"));
  write("chair/train/a.off", "solid\n");
  EXPECT_THAT(refusal("modelnet"), HasSubstr("a.off:1: the file does not begin with 'OFF'"));
}

TEST_F(ImportPrinceton, TakesClassesFromTheClassification) {
  write("classification/v1/base/train.cla", "PSB 1\n3 2\nfurniture 0 0\nchair furniture 1\n7\n\nplane 0 1\n1118\n");
  write("classification/v1/base/test.cla", "PSB 1\n1 1\nchair 0 1\n8\n");
  write("classification/v1/coarse3/train.cla", "PSB 1\n1 1\nthing 0 1\n7\n");
  write("classification/v1/coarse3/test.cla", "PSB 1\n1 1\nthing 0 1\n8\n");
  for (const char* model : {"0/m7/m7", "0/m8/m8", "11/m1118/m1118"}) {
    write("db/" + std::string(model) + ".off", offBox("OFF\n8 6 0", 1, 2, 3));
  }
  const DataSet set = imported("psb", {"--points", "100"});
  ASSERT_EQ(set.training.size(), 2u);
  EXPECT_EQ(set.training[0].object, "chair");
  EXPECT_EQ(set.training[1].object, "plane");
  EXPECT_EQ(set.training[1].source, "set_clouds/m1118.pcd");
  ASSERT_EQ(set.tests.size(), 1u);
  EXPECT_EQ(set.tests[0].object, "chair");
  EXPECT_NEAR(boxOf(readCloud(set.tests[0].path)).diagonal().norm(), 0.5, 1e-5);
  EXPECT_EQ(imported("psb", {"--force", "--points", "100", "--classification", "coarse3"}).training[0].object, "thing");
}

TEST_F(ImportPrinceton, NamesWhatIsWrong) {
  EXPECT_THAT(refusal("psb"), HasSubstr("has no base/train.cla: it is not the Princeton Shape Benchmark"));
  write("classification/v1/coarse1/train.cla", "");
  EXPECT_THAT(refusal("psb"), HasSubstr("--classification can be one of coarse1"));
  write("classification/v1/base/test.cla", "PSB 1\n0 0\n");
  write("classification/v1/base/train.cla", "PSB 1\n1 2\nchair 0 2\n7\n");
  EXPECT_THAT(refusal("psb"), HasSubstr("train.cla: it ends within class 'chair'"));
  write("classification/v1/base/train.cla", "PSB 1\n1 2\nchair 0 1\n7\n");
  EXPECT_THAT(refusal("psb"), HasSubstr("announces 2 models but lists 1"));
  write("classification/v1/base/train.cla", "PSB 1\n1 1\nchair 0 1\n7\n");
  EXPECT_THAT(refusal("psb"), HasSubstr("has no folder db"));
  std::filesystem::create_directories(place("db/0"));
  EXPECT_THAT(refusal("psb"), HasSubstr("m7.off"));
}

TEST_F(ImportWashington, TestsTheLastInstanceOfEachCategory) {
  const std::string cloud = pcdText({{0, 0, 1}, {0.1, 0, 1}, {0, 0.1, 1}});
  for (const char* instance : {"1", "2", "10"}) {
    for (const char* frame : {"1", "2", "3", "10"}) {
      const std::string name = std::string("apple_") + instance;
      write("apple/" + name + "/" + name + "_1_" + frame + ".pcd", cloud);
    }
  }
  const DataSet set = imported("washington", {"--every", "3"});
  ASSERT_EQ(set.training.size(), 4u);  // frames 1 and 10 of instances 1 and 2
  EXPECT_EQ(set.training[0].object, "apple");
  EXPECT_EQ(set.training[0].kind, ViewKind::view);
  EXPECT_EQ(set.training[1].source, "../download/apple/apple_1/apple_1_1_10.pcd");
  ASSERT_EQ(set.tests.size(), 2u);
  EXPECT_THAT(set.tests[0].path, HasSubstr("apple_10_1_1.pcd"));
  EXPECT_EQ(set.scale, 1.0);
}

TEST_F(ImportWashington, RecognisesMillimetresAndForeignFolders) {
  EXPECT_THAT(refusal("washington"), HasSubstr("is not the Washington RGB-D data set"));
  write("apple/apple_1/apple_1_1_1.pcd", pcdText({{0, 0, 800}, {10, 0, 800}}));
  EXPECT_EQ(imported("washington").scale, 0.001);
  EXPECT_EQ(imported("washington", {"--force", "--units", "m"}).scale, 1.0);
}

TEST_F(ImportBigBird, TestsEverySecondTurn) {
  for (const char* name : {"NP1_0", "NP2_0", "NP1_3", "NP2_3", "NP1_12", "other"}) {
    write("zilla_night_black_heat/clouds/" + std::string(name) + ".pcd", pcdText({{0, 0, 1}}));
  }
  write("zilla_night_black_heat/calibration.h5", "");
  const DataSet set = imported("bigbird");
  ASSERT_EQ(set.training.size(), 3u);  // turns 0 and 12
  EXPECT_EQ(set.training[0].object, "zilla_night_black_heat");
  EXPECT_EQ(set.training[2].source, "../download/zilla_night_black_heat/clouds/NP1_12.pcd");
  ASSERT_EQ(set.tests.size(), 2u);
  EXPECT_THAT(set.tests[1].path, HasSubstr("NP2_3.pcd"));
}

TEST_F(ImportBigBird, NamesWhatIsWrong) {
  EXPECT_THAT(refusal("bigbird"), HasSubstr("there is no <object>/clouds/NP<camera>_<angle>.pcd in it"));
}

TEST_F(ImportModelNet, BadUsageHasItsOwnStatus) {
  EXPECT_EQ(import("shapenet").status, 2);
  EXPECT_THAT(import("shapenet").errors, HasSubstr("shapenet"));
  const test::CommandRun run = test::runSks({"import", "bop", folder_.path("absent"), "-o", output()});
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.errors, HasSubstr("is no folder; give the one that the data set lies in"));
}

}  // namespace
}  // namespace sks

#endif
