// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/evaluation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/cloud_io.hpp>

#include "error_of.hpp"
#include "temporary_folder.hpp"

namespace sks {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

Detection detectionAt(const std::string& object, double x, double score) {
  Detection detection;
  detection.object = object;
  detection.score = score;
  detection.T_scene_box.translation() = Eigen::Vector3d(x, 0, 1);
  return detection;
}

GroundTruth truthAt(const std::string& object, double x) {
  GroundTruth truth;
  truth.object = object;
  truth.position = {x, 0, 1};
  return truth;
}

/// Two scenes whose clouds have one and two points, so that a detector can tell them apart.
class TwoScenes : public ::testing::Test {
protected:
  void SetUp() override {
    data_set_.name = "toys";
    data_set_.file = "toys.yaml";
    data_set_.max_distance = 0.05;
    for (std::size_t i = 1; i <= 2; ++i) {
      Scene scene;
      scene.name = "scene" + std::to_string(i);
      scene.path = folder_.path(scene.name + ".pcd");
      Cloud cloud;
      cloud.width = std::uint32_t(i);
      cloud.points.assign(i, {0, 0, 1});
      writeCloud(scene.path, cloud);
      data_set_.scenes.push_back(scene);
    }
    data_set_.scenes[0].objects = {truthAt("duck", 0), truthAt("frog", 0.5)};
    data_set_.scenes[1].objects = {truthAt("duck", 0)};
    data_set_.scenes[1].ignore = {"frog"};
    settings_.detection.threshold = 0.5;
  }

  /// Finds the duck everywhere, a swan that is nowhere, and a frog only in the second scene.
  static DetectionResult detect(const Cloud& cloud) {
    DetectionResult result;
    if (cloud.size() == 1) {
      result.detections = {detectionAt("duck", 0.01, 0.9), detectionAt("swan", 0, 0.6), detectionAt("frog", 0.5, 0.3)};
    } else {
      result.detections = {detectionAt("frog", 0, 0.8), detectionAt("duck", 0.01, 0.7), detectionAt("duck", 1, 0.4)};
    }
    result.times.total = 0.01 * double(cloud.size());
    result.times.matching = 0.001;
    result.counts.input_points = cloud.size();
    return result;
  }

  Evaluation evaluated() const { return evaluate(data_set_, detect, "sks", settings_); }

  test::TemporaryFolder folder_;
  DataSet data_set_;
  Settings settings_;
};

TEST_F(TwoScenes, CountsOverAllScenesAtTheFixedThreshold) {
  const Evaluation evaluation = evaluated();
  EXPECT_EQ(evaluation.data_set, "toys");
  EXPECT_EQ(evaluation.method, "sks");
  EXPECT_EQ(evaluation.threshold, 0.5);
  EXPECT_EQ(evaluation.total.tally.ground_truth, 3u);
  EXPECT_EQ(evaluation.total.tally.true_positives, 2u);   // both ducks
  EXPECT_EQ(evaluation.total.tally.false_positives, 1u);  // the swan; the frog of scene 2 is ignored
  EXPECT_DOUBLE_EQ(*evaluation.total.tally.f1(), 4.0 / 6.0);
  // ranking: duck 0.9 hit, duck 0.7 hit, swan 0.6, duck 0.4, frog 0.3 hit
  EXPECT_DOUBLE_EQ(*evaluation.total.average_precision, (1 + 1 + 0.6) / 3);
}

TEST_F(TwoScenes, ScoresEachObjectWithThoseThatAreNowhere) {
  const Evaluation evaluation = evaluated();
  std::vector<std::string> names;
  for (const auto& object : evaluation.objects) names.push_back(object.first);
  EXPECT_THAT(names, ElementsAre("duck", "frog", "swan"));
  const Score& duck = evaluation.objects.at("duck");
  EXPECT_EQ(duck.tally.ground_truth, 2u);
  EXPECT_EQ(duck.tally.f1(), 1.0);
  EXPECT_EQ(duck.average_precision, 1.0);
  const Score& frog = evaluation.objects.at("frog");
  EXPECT_EQ(frog.tally.ground_truth, 1u);
  EXPECT_EQ(frog.tally.f1(), 0.0);
  EXPECT_EQ(frog.average_precision, 1.0);
  const Score& swan = evaluation.objects.at("swan");
  EXPECT_EQ(swan.tally.false_positives, 1u);
  EXPECT_EQ(swan.tally.precision(), 0.0);
  EXPECT_FALSE(swan.tally.recall());
  EXPECT_FALSE(swan.average_precision);
}

TEST_F(TwoScenes, KeepsWhatWasFoundInEachScene) {
  const Evaluation evaluation = evaluated();
  ASSERT_EQ(evaluation.scenes.size(), 2u);
  EXPECT_EQ(evaluation.scenes[0].scene.name, "scene1");
  EXPECT_EQ(evaluation.scenes[1].counts.input_points, 2u);
  ASSERT_EQ(evaluation.scenes[1].detections.size(), 3u);
  EXPECT_EQ(evaluation.scenes[1].detections[0].outcome, Outcome::ignored);
  EXPECT_EQ(evaluation.scenes[1].detections[1].outcome, Outcome::true_positive);
  EXPECT_EQ(evaluation.scenes[1].detections[2].outcome, Outcome::false_positive);
}

TEST_F(TwoScenes, SpreadsTimesOverScenesInMilliseconds) {
  const Evaluation evaluation = evaluated();
  std::vector<std::string> stages;
  for (const auto& stage : evaluation.times) stages.push_back(stage.first);
  EXPECT_THAT(stages, ElementsAre("total", "sanitize", "normals", "keypoints", "descriptors", "matching", "voting",
                                  "verification"));
  const TimeQuantiles& total = evaluation.times[0].second;  // 10 and 20 ms
  EXPECT_DOUBLE_EQ(total.mean, 15);
  EXPECT_DOUBLE_EQ(total.p50, 15);
  EXPECT_DOUBLE_EQ(total.p95, 19.5);
  EXPECT_DOUBLE_EQ(evaluation.times[5].second.p95, 1);
  EXPECT_GT(evaluation.peak_memory_mb, 1);
}

TEST_F(TwoScenes, TakesPoseErrorsOfTruePositivesAtTheThreshold) {
  GroundTruth& truth = data_set_.scenes[0].objects[0];
  truth.reference = "duck0.pcd";
  truth.T_scene_reference = Eigen::Isometry3d::Identity();
  const auto posed = [](const Cloud& cloud) {
    DetectionResult result = detect(cloud);
    Detection& duck = result.detections[0];
    duck.view = "duck0.pcd";
    duck.T_scene_model.translation() = Eigen::Vector3d(0, 0, 0.002);
    return result;
  };
  const Evaluation evaluation = evaluate(data_set_, posed, "sks", settings_);
  EXPECT_EQ(evaluation.total.pose.count, 1u);
  ASSERT_TRUE(evaluation.total.pose.translation);
  EXPECT_DOUBLE_EQ(evaluation.total.pose.translation->median, 0.002);
  EXPECT_DOUBLE_EQ(evaluation.total.pose.t_diff->p90, 0.002);
  EXPECT_DOUBLE_EQ(evaluation.objects.at("duck").pose.rotation->median, 0);
  EXPECT_FALSE(evaluation.objects.at("frog").pose.rotation);

  settings_.detection.threshold = 0.95;
  EXPECT_EQ(evaluate(data_set_, posed, "sks", settings_).total.pose.count, 0u);
}

TEST_F(TwoScenes, NothingInTheScenesLeavesTheMeasuresUndefined) {
  for (Scene& scene : data_set_.scenes) scene.objects.clear();
  const Evaluation evaluation = evaluated();
  EXPECT_EQ(evaluation.total.tally.ground_truth, 0u);
  EXPECT_EQ(evaluation.total.tally.false_positives, 3u);
  EXPECT_FALSE(evaluation.total.tally.f1());
  EXPECT_FALSE(evaluation.total.average_precision);
}

TEST_F(TwoScenes, ErrorsNameTheSceneAndItsFile) {
  const auto fails = [](const Cloud&) -> DetectionResult { throw Error(ErrorCode::bad_data, "no finite point"); };
  const std::string unusable =
      test::errorOf(ErrorCode::bad_data, [&] { evaluate(data_set_, fails, "sks", settings_); });
  EXPECT_EQ(unusable, "scene 'scene1' (" + data_set_.scenes[0].path + "): no finite point");

  data_set_.scenes[1].path = folder_.path("gone.pcd");
  const std::string missing = test::errorOf(ErrorCode::bad_file, [&] { evaluated(); });
  EXPECT_THAT(missing, HasSubstr("scene 'scene2' (" + folder_.path("gone.pcd") + "): "));

  data_set_.scenes.clear();
  EXPECT_THAT(test::errorOf(ErrorCode::bad_data, [&] { evaluated(); }), HasSubstr("'toys.yaml' has no scenes"));
}

TEST_F(TwoScenes, ReportsProgressAndCanBeCancelled) {
  std::vector<std::pair<std::size_t, std::string>> seen;
  const auto watch = [&](const ProgressState& state) {
    EXPECT_EQ(state.total, 2u);
    seen.emplace_back(state.done, state.item);
    return true;
  };
  evaluate(data_set_, detect, "sks", settings_, watch);
  EXPECT_THAT(seen, ElementsAre(Pair(0u, "scene1"), Pair(1u, "scene2"), Pair(2u, "")));

  const auto stop = [](const ProgressState& state) { return state.done == 0; };
  EXPECT_EQ(test::errorOf(ErrorCode::cancelled, [&] { evaluate(data_set_, detect, "sks", settings_, stop); }),
            "evaluating was cancelled after 1 of 2");
}

}  // namespace
}  // namespace sks
