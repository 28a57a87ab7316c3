// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/scene_matching.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace sks {
namespace {

constexpr double max_distance = 0.05;

GroundTruth objectAt(const std::string& object, double x) {
  GroundTruth truth;
  truth.object = object;
  truth.position = {x, 0, 1};
  return truth;
}

Scene sceneOf(const std::vector<GroundTruth>& objects) {
  Scene scene;
  scene.name = "scene";
  scene.objects = objects;
  return scene;
}

Detection candidateAt(const std::string& object, double x, double score) {
  Detection detection;
  detection.object = object;
  detection.score = score;
  detection.T_scene_box.translation() = Eigen::Vector3d(x, 0, 1);
  return detection;
}

std::vector<Outcome> outcomes(const std::vector<MatchedDetection>& matched) {
  std::vector<Outcome> result;
  for (const MatchedDetection& j : matched) result.push_back(j.outcome);
  return result;
}

constexpr Outcome hit = Outcome::true_positive;
constexpr Outcome alarm = Outcome::false_positive;

TEST(SceneMatching, OfTwoThatCompeteForOneTheHigherScoreWins) {
  const Scene scene = sceneOf({objectAt("duck", 0)});
  const auto matched =
      matchScene(scene, {candidateAt("duck", 0.001, 0.6), candidateAt("duck", 0.04, 0.9)}, max_distance);
  EXPECT_EQ(outcomes(matched), (std::vector<Outcome>{hit, alarm}));
  EXPECT_EQ(matched[0].detection.score, 0.9);
  EXPECT_EQ(matched[0].ground_truth, 0u);
  EXPECT_FALSE(matched[1].ground_truth);
}

TEST(SceneMatching, TheSecondTakesTheNearestThatIsStillFree) {
  const Scene scene = sceneOf({objectAt("duck", 0), objectAt("duck", 0.06)});
  // both are nearest to the first instance; the weaker one is within reach of the second
  const auto matched = matchScene(scene, {candidateAt("duck", 0.0, 0.9), candidateAt("duck", 0.02, 0.8)}, max_distance);
  EXPECT_EQ(outcomes(matched), (std::vector<Outcome>{hit, hit}));
  EXPECT_EQ(matched[0].ground_truth, 0u);
  EXPECT_EQ(matched[1].ground_truth, 1u);
}

TEST(SceneMatching, ADetectionThatIsTooFarLeavesTheGroundTruthFree) {
  const Scene scene = sceneOf({objectAt("duck", 0)});
  const auto matched =
      matchScene(scene, {candidateAt("duck", 0.051, 0.9), candidateAt("duck", 0.05, 0.8)}, max_distance);
  EXPECT_EQ(outcomes(matched), (std::vector<Outcome>{alarm, hit}));  // the limit itself is within
}

TEST(SceneMatching, FalsePositivesOfAbsentClassesCount) {
  const Scene scene = sceneOf({objectAt("duck", 0)});
  const auto matched = matchScene(scene, {candidateAt("frog", 0, 0.9), candidateAt("duck", 0, 0.5)}, max_distance);
  EXPECT_EQ(outcomes(matched), (std::vector<Outcome>{alarm, hit}));
  EXPECT_EQ(outcomes(matchScene(sceneOf({}), {candidateAt("duck", 0, 0.9)}, max_distance)),
            (std::vector<Outcome>{alarm}));
}

TEST(SceneMatching, IgnoredObjectsCountNeitherWay) {
  Scene scene = sceneOf({objectAt("duck", 0), objectAt("frog", 0.5)});
  scene.ignore = {"frog", "mario"};
  const auto matched = matchScene(
      scene, {candidateAt("frog", 0.5, 0.9), candidateAt("mario", 0, 0.8), candidateAt("duck", 0, 0.7)}, max_distance);
  EXPECT_EQ(outcomes(matched), (std::vector<Outcome>{Outcome::ignored, Outcome::ignored, hit}));
  EXPECT_FALSE(matched[0].ground_truth);
  EXPECT_TRUE(isIgnored(scene, "frog"));
  EXPECT_FALSE(isIgnored(scene, "duck"));
}

TEST(SceneMatching, WeakDetectionsDoNotChangeWhatBecomesOfStrongOnes) {
  const Scene scene = sceneOf({objectAt("duck", 0), objectAt("duck", 0.06)});
  std::vector<Detection> detections{candidateAt("duck", 0.03, 0.9), candidateAt("duck", 0.05, 0.6)};
  const auto strong = matchScene(scene, detections, max_distance);
  detections.push_back(candidateAt("duck", 0.0, 0.1));
  const auto all = matchScene(scene, detections, max_distance);
  ASSERT_EQ(all.size(), 3u);
  for (std::size_t i = 0; i < strong.size(); ++i) {
    EXPECT_EQ(all[i].outcome, strong[i].outcome);
    EXPECT_EQ(all[i].ground_truth, strong[i].ground_truth);
  }
}

TEST(SceneMatching, TheOrderOfEqualScoresDoesNotMatter) {
  const Scene scene = sceneOf({objectAt("duck", 0), objectAt("duck", 0.08)});
  std::vector<Detection> detections{candidateAt("duck", 0.07, 0.5), candidateAt("duck", 0.03, 0.5),
                                    candidateAt("duck", -0.04, 0.5), candidateAt("frog", 0.0, 0.5)};
  const auto expected = matchScene(scene, detections, max_distance);
  std::vector<std::size_t> order{0, 1, 2, 3};
  do {
    std::vector<Detection> permuted;
    for (const std::size_t i : order) permuted.push_back(detections[i]);
    const auto matched = matchScene(scene, permuted, max_distance);
    EXPECT_EQ(outcomes(matched), outcomes(expected));
    for (std::size_t i = 0; i < matched.size(); ++i) {
      EXPECT_EQ(matched[i].detection.position(), expected[i].detection.position());
    }
  } while (std::next_permutation(order.begin(), order.end()));
}

/// The box of a model that was seen from all sides has another centre than that of the single view to which the ground
/// truth refers: what is compared is one point of the object.
TEST(SceneMatching, ComparesTheSamePointInARegisteredFrame) {
  GroundTruth truth = objectAt("duck", 0);
  truth.model_frame = "duck#model";
  truth.T_scene_model = Eigen::Translation3d(0.07, 0, 1) * Eigen::AngleAxisd(2, Eigen::Vector3d::UnitY());
  Detection detection = candidateAt("duck", 0.06, 0.9);
  detection.view = "duck#model";
  detection.T_scene_model = *truth.T_scene_model;
  EXPECT_EQ(matchScene(sceneOf({truth}), {detection}, max_distance)[0].outcome, hit);
  detection.T_scene_model = Eigen::Translation3d(0, 0.051, 0) * *truth.T_scene_model;
  EXPECT_EQ(matchScene(sceneOf({truth}), {detection}, max_distance)[0].outcome, alarm);
  // half a turn about the middle of the model puts that point elsewhere, wherever the box is
  detection = candidateAt("duck", 0, 0.9);
  detection.view = "duck#model";
  detection.T_scene_model = *truth.T_scene_model * Eigen::AngleAxisd(EIGEN_PI, Eigen::Vector3d::UnitY());
  EXPECT_EQ(matchScene(sceneOf({truth}), {detection}, max_distance)[0].outcome, alarm);
  // a detection in another frame says where that point is by its box alone
  detection.view = "duck7.pcd";
  EXPECT_EQ(matchScene(sceneOf({truth}), {detection}, max_distance)[0].outcome, hit);
}

/// A duck whose true pose is known, and a detection with its pose turned by `degrees` about z through the box centre.
struct PoseCase {
  GroundTruth truth = objectAt("duck", 0.1);
  Detection detection = candidateAt("duck", 0.1, 0.9);

  explicit PoseCase(double degrees) {
    truth.reference = "views/duck0.pcd";
    truth.T_scene_reference = Eigen::Translation3d(0.3, 0, 0.2) * Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitX());
    const Eigen::Isometry3d turn = Eigen::Translation3d(truth.position) *
                                   Eigen::AngleAxisd(degrees * EIGEN_PI / 180, Eigen::Vector3d::UnitZ()) *
                                   Eigen::Translation3d(-truth.position);
    detection.T_scene_model = turn * *truth.T_scene_reference;
    detection.view = truth.reference;
  }
};

TEST(PoseError, ARotationAboutTheBoxCentreMovesNothing) {
  const PoseCase c(30);
  const PoseError error = poseError(c.detection.T_scene_model, *c.truth.T_scene_reference, c.truth.position);
  EXPECT_NEAR(error.translation, 0, 1e-12);
  EXPECT_NEAR(error.rotation, 30, 1e-9);
}

TEST(PoseError, TDiffOfAKnownRotationIsTheFrobeniusNorm) {
  // the identity against 90 degrees about z: two columns differ by (1, -1), so the norm is 2; with an offset 0.6, 0.8
  Eigen::Isometry3d found = Eigen::Isometry3d::Identity();
  found.linear() = Eigen::AngleAxisd(EIGEN_PI / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  EXPECT_NEAR(poseError(found, Eigen::Isometry3d::Identity(), Eigen::Vector3d::Zero()).t_diff, 2.0, 1e-12);
  found.translation() = Eigen::Vector3d(0.6, 0.8, 0);
  const PoseError error = poseError(found, Eigen::Isometry3d::Identity(), Eigen::Vector3d::Zero());
  EXPECT_NEAR(error.t_diff, std::sqrt(5.0), 1e-12);
  EXPECT_NEAR(error.translation, 1.0, 1e-12);
  EXPECT_NEAR(error.rotation, 90, 1e-9);
}

TEST(PoseError, IsTakenOnlyInTheFrameOfTheReference) {
  PoseCase c(10);
  auto matched = matchScene(sceneOf({c.truth}), {c.detection}, max_distance);
  ASSERT_TRUE(matched[0].pose_error);
  EXPECT_NEAR(matched[0].pose_error->rotation, 10, 1e-9);

  Detection other_view = c.detection;
  other_view.view = "views/duck1.pcd";
  matched = matchScene(sceneOf({c.truth}), {other_view}, max_distance);
  EXPECT_EQ(matched[0].outcome, hit);
  EXPECT_FALSE(matched[0].pose_error);

  GroundTruth no_pose = c.truth;
  no_pose.T_scene_reference.reset();
  EXPECT_FALSE(matchScene(sceneOf({no_pose}), {c.detection}, max_distance)[0].pose_error);
}

}  // namespace
}  // namespace sks
