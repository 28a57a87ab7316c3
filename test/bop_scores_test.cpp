// SPDX-License-Identifier: BSD-3-Clause
// Average recalls of a scene of plates whose errors are counted by hand.
#include "evaluation/bop_scores.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/cloud_io.hpp>
#include <sks_detector/error.hpp>

#include "plate.hpp"
#include "temporary_folder.hpp"

namespace sks {
namespace {

using test::at;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// An empty table at 1 m: what a camera of 100 x 80 pixels sees of it.
Cloud tableAtOneMetre() {
  const SceneCamera camera = test::plateCamera();
  Cloud cloud;
  cloud.width = std::uint32_t(camera.width);
  cloud.height = std::uint32_t(camera.height);
  for (int row = 0; row < camera.height; ++row) {
    for (int column = 0; column < camera.width; ++column) {
      cloud.points.emplace_back(float((column - camera.cx) / camera.fx), float((row - camera.cy) / camera.fy), 1.0f);
    }
  }
  return cloud;
}

class BopScoresOfPlates : public ::testing::Test {
protected:
  void SetUp() override {
    writeCloud(folder_.path("scene.pcd"), tableAtOneMetre());
    addScene();
    for (const char* object : {"plate", "other"}) {
      TrainingEntry entry;
      entry.object = object;
      entry.source = entry.path = object + std::string(".ply");
      entry.mesh = true;
      data_set_.training.push_back(entry);
    }
  }

  void addScene() {
    Scene scene;
    scene.name = "scene" + std::to_string(data_set_.scenes.size());
    scene.path = folder_.path("scene.pcd");
    data_set_.scenes.push_back(scene);
    found_.emplace_back();
  }

  GroundTruth& addTruth(const std::string& object, const Eigen::Isometry3d& pose) {
    GroundTruth truth;
    truth.object = object;
    truth.reference = object + ".ply";
    truth.T_scene_reference = pose;
    data_set_.scenes.back().objects.push_back(truth);
    return data_set_.scenes.back().objects.back();
  }

  Detection& addFound(const std::string& object, const Eigen::Isometry3d& pose) {
    MatchedDetection matched;
    matched.detection.object = object;
    matched.detection.view = object + ".ply";
    matched.detection.T_scene_model = pose;
    found_.back().push_back(matched);
    return found_.back().back().detection;
  }

  BopScores scores(int threads = 1) const {
    return bopScores(
        data_set_, found_, [](const TrainingEntry&) { return test::plate(); }, threads);
  }

  test::TemporaryFolder folder_;
  DataSet data_set_;
  std::vector<std::vector<MatchedDetection>> found_;
};

TEST_F(BopScoresOfPlates, AreOneForTruePosesAndZeroForNone) {
  addTruth("plate", at(0, 0, 1));
  addTruth("other", at(0.25, 0, 1));
  addFound("plate", at(0, 0, 1));
  const BopScores result = scores();
  EXPECT_THAT(result.shortcomings, IsEmpty());
  const BopRecall plate = result.objects.at("plate"), other = result.objects.at("other");
  for (const auto& value : {plate.vsd, plate.mssd, plate.mspd, plate.ar}) EXPECT_EQ(value, 1.0);
  for (const auto& value : {other.vsd, other.mssd, other.mspd, other.ar}) EXPECT_EQ(value, 0.0);
  EXPECT_EQ(result.total.targets, 2u);
  for (const auto& value : {result.total.vsd, result.total.mssd, result.total.mspd, result.total.ar}) {
    EXPECT_EQ(value, 0.5);
  }
}

TEST_F(BopScoresOfPlates, CountTheThresholdsThatAnErrorIsBelow) {
  addTruth("plate", at(0, 0, 1));
  addFound("plate", at(0.03, 0, 1));
  const BopRecall recall = scores().total;
  // 0.03 m of a diameter of 0.283 m is 0.106: below 0.15 to 0.5
  EXPECT_NEAR(*recall.mssd, 0.8, 1e-12);
  // 3 pixels of an image of 100 are 19.2 of one of 640: below 20 to 50
  EXPECT_NEAR(*recall.mspd, 0.7, 1e-12);
  // 3 columns of each pose are not the other's: 6 of 23 are 0.26, below 0.3 to 0.5, whatever the tolerance along the
  // ray
  EXPECT_NEAR(*recall.vsd, 0.5, 1e-12);
  EXPECT_NEAR(*recall.ar, 2.0 / 3, 1e-12);
}

TEST_F(BopScoresOfPlates, VsdTakesEveryTolerance) {
  addTruth("plate", at(0, 0, 1));
  addFound("plate", at(0, 0, 1.04));
  // 40 to 41 mm along the ray are 0.141 to 0.145 of the diameter: within 0.15 to 0.5
  EXPECT_NEAR(*scores().total.vsd, 0.8, 1e-12);
}

TEST_F(BopScoresOfPlates, HalfTurnsOfSymmetricObjectsAreRight) {
  addTruth("plate", at(0, 0, 1));
  const Eigen::Vector3d center(0.005, 0.005, 0);
  const Eigen::Isometry3d half_turn = Eigen::Translation3d(center) *
                                      Eigen::AngleAxisd(EIGEN_PI, Eigen::Vector3d::UnitZ()) *
                                      Eigen::Translation3d(-center);
  addFound("plate", at(0, 0, 1) * half_turn);
  EXPECT_EQ(scores().total.mssd, 0.0);
  const auto loader = [&](const TrainingEntry&) {
    ObjectModel model = test::plate();
    model.symmetries.push_back(half_turn);
    return model;
  };
  const BopRecall symmetric = bopScores(data_set_, found_, loader, 1).total;
  EXPECT_EQ(symmetric.mssd, 1.0);
  EXPECT_EQ(symmetric.mspd, 1.0);
}

TEST_F(BopScoresOfPlates, AskForWhatIsVisibleAndNotIgnored) {
  addTruth("plate", at(0, 0, 1)).visibility = 0.1;
  addTruth("plate", at(0.2, 0, 1)).visibility = 0.09;
  addTruth("other", at(0, 0.2, 1));
  data_set_.scenes.back().ignore = {"other"};
  addFound("plate", at(0, 0, 1));
  addFound("plate", at(0.2, 0, 1));
  const BopScores result = scores();
  EXPECT_EQ(result.objects.size(), 1u);
  EXPECT_EQ(result.total.targets, 1u);
  EXPECT_EQ(result.total.ar, 1.0);
}

TEST_F(BopScoresOfPlates, LookAtAsManyDetectionsAsTargets) {
  addTruth("plate", at(0, 0, 1));
  addFound("plate", at(0.4, 0, 1));
  addFound("plate", at(0, 0, 1));
  EXPECT_EQ(scores().total.ar, 0.0);
  addTruth("plate", at(0.25, 0, 1));
  EXPECT_EQ(scores().total.ar, 0.5);
}

TEST_F(BopScoresOfPlates, ArePooledOverScenes) {
  addTruth("plate", at(0, 0, 1));
  addFound("plate", at(0, 0, 1));
  addScene();
  addTruth("plate", at(0, 0, 1));
  addTruth("plate", at(0.25, 0, 1));
  EXPECT_NEAR(*scores().total.ar, 1.0 / 3, 1e-12);
}

TEST_F(BopScoresOfPlates, DoNotDependOnTheThreads) {
  addTruth("plate", at(0, 0, 1));
  addFound("plate", at(0.021, 0.013, 1.03));
  const BopRecall one = scores(1).total, four = scores(4).total;
  EXPECT_EQ(one.vsd, four.vsd);
  EXPECT_EQ(one.mssd, four.mssd);
  EXPECT_EQ(one.mspd, four.mspd);
  EXPECT_GT(*one.ar, 0);
}

TEST_F(BopScoresOfPlates, WithoutACameraThereIsTheDistanceInSpaceAlone) {
  Cloud heap = tableAtOneMetre();
  heap.width = std::uint32_t(heap.size());
  heap.height = 1;
  writeCloud(folder_.path("scene.pcd"), heap);
  addTruth("plate", at(0, 0, 1));
  addFound("plate", at(0, 0, 1));
  const BopScores result = scores();
  EXPECT_EQ(result.total.mssd, 1.0);
  for (const auto& value : {result.total.vsd, result.total.mspd, result.total.ar}) EXPECT_FALSE(value);
  EXPECT_THAT(result.shortcomings.at("plate"), HasSubstr("the cloud of scene 'scene0' is not organised"));
}

TEST_F(BopScoresOfPlates, WithoutAMeshThereIsNoVsd) {
  addTruth("plate", at(0, 0, 1));
  addFound("plate", at(0, 0, 1));
  const auto loader = [&](const TrainingEntry&) {
    ObjectModel model = test::plate();
    model.triangles.clear();
    return model;
  };
  data_set_.training[0].mesh = false;
  data_set_.training[0].kind = ViewKind::model;
  const BopScores result = bopScores(data_set_, found_, loader, 1);
  EXPECT_EQ(result.total.mssd, 1.0);
  EXPECT_EQ(result.total.mspd, 1.0);
  EXPECT_FALSE(result.total.vsd);
  EXPECT_FALSE(result.total.ar);
  EXPECT_THAT(result.shortcomings.at("plate"), HasSubstr("VSD needs a mesh"));
}

TEST_F(BopScoresOfPlates, SayWhyAnObjectHasNone) {
  const auto reason = [&] {
    const BopScores result = scores();
    EXPECT_EQ(result.objects.at("plate").targets, 1u);
    EXPECT_FALSE(result.total.mssd);
    return result.shortcomings.at("plate");
  };
  addTruth("plate", at(0, 0, 1));
  addFound("plate", at(0, 0, 1)).view = "view7.pcd";
  EXPECT_THAT(reason(), HasSubstr("in scene 'scene0' it was found in the frame of 'view7.pcd'"));
  data_set_.training[0].mesh = false;
  EXPECT_THAT(reason(), HasSubstr("it is trained from views"));
  data_set_.training[0].source = "elsewhere.ply";
  EXPECT_THAT(reason(), HasSubstr("'plate.ply' is not under 'training'"));
  data_set_.scenes[0].objects[0].T_scene_reference.reset();
  EXPECT_THAT(reason(), HasSubstr("its ground truth has no pose"));
}

TEST_F(BopScoresOfPlates, AModelThatCannotBeReadIsSuchAReason) {
  addTruth("plate", at(0, 0, 1));
  const BopScores result = bopScores(
      data_set_, found_,
      [](const TrainingEntry&) -> ObjectModel { throw Error(ErrorCode::bad_file, "plate.ply is damaged"); }, 1);
  EXPECT_FALSE(result.total.mssd);
  EXPECT_EQ(result.shortcomings.at("plate"), "plate.ply is damaged");
}

TEST_F(BopScoresOfPlates, OfMixedSetsTheMeanNeedsTheSameTargets) {
  addTruth("plate", at(0, 0, 1));
  addTruth("other", at(0, 0.2, 1));
  addFound("plate", at(0, 0, 1));
  data_set_.training[1].mesh = false;
  data_set_.training[1].kind = ViewKind::model;
  const auto loader = [&](const TrainingEntry& entry) {
    ObjectModel model = test::plate();
    if (!entry.mesh) model.triangles.clear();
    return model;
  };
  const BopScores result = bopScores(data_set_, found_, loader, 1);
  EXPECT_EQ(result.total.vsd, 1.0);   // the plate alone
  EXPECT_EQ(result.total.mssd, 0.5);  // both
  EXPECT_FALSE(result.total.ar);
  EXPECT_EQ(result.objects.at("plate").ar, 1.0);
}

}  // namespace
}  // namespace sks
