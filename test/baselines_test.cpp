// SPDX-License-Identifier: BSD-3-Clause
// The pipelines that the detector is compared with, each on objects of known places.
#ifdef SKS_EXECUTABLE  // they come with the command line

#include "baselines/methods.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "baselines/framed_models.hpp"
#include "error_of.hpp"
#include "synthetic.hpp"
#include "training_samples.hpp"

namespace sks {
namespace {

using baselines::makeClassify;
using baselines::makeDetect;
using baselines::MethodSettings;
using test::errorOf;
using test::Placed;
using test::poseOf;
using test::sampleOf;
using ::testing::HasSubstr;

const Eigen::Vector3f away(0, 0, 0.8f);

Cloud viewOf(const test::Shape& shape, float degrees = 35) {
  return test::transformed(test::view({Placed{shape, poseOf(degrees, {1, 2, 0.5f}, away)}}),
                           poseOf(0, {0, 0, 1}, -away));
}

Settings wholeGrid() {
  Settings settings;
  settings.keypoints.discard = 0;
  return settings;
}

std::shared_ptr<const Codebook> twoObjects() {
  static const auto codebook = std::make_shared<const Codebook>(
      train({sampleOf("thing", viewOf(test::asymmetricShape()), ViewKind::view, "thing.pcd"),
             sampleOf("round", viewOf(test::roundedShape()), ViewKind::view, "round.pcd")},
            Settings(), "synthetic"));
  return codebook;
}

/// A moved and turned copy of the training view before a wall.
const Eigen::Isometry3f T_scene_thing = poseOf(20, {0, 0.3f, 1}, {-0.1f, 0.05f, 0.85f});

Cloud sceneOfThing() {
  std::vector<Eigen::Vector3f> wall;
  for (float x = -0.5f; x < 0.5f; x += 0.005f) {
    for (float y = -0.4f; y < 0.4f; y += 0.005f) wall.emplace_back(x, y, 1.2f + 0.1f * x);
  }
  return test::merged(
      {test::transformed(viewOf(test::asymmetricShape()), T_scene_thing), test::makeCloud(std::move(wall))});
}

class SceneMethod : public ::testing::TestWithParam<const char*> {
protected:
  DetectionResult detect(const Settings& settings) const {
    Cloud scene = sceneOfThing();
    scene.sensor_origin.setZero();
    return makeDetect(GetParam(), twoObjects(), settings, MethodSettings())(scene);
  }
};

TEST_P(SceneMethod, FindsTheObjectWithItsPose) {
  ::testing::internal::CaptureStderr();
  const DetectionResult result = detect(wholeGrid());
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << "PCL is silenced";
  ASSERT_FALSE(result.detections.empty());
  const Detection& best = result.detections.front();
  EXPECT_EQ(best.object, "thing");
  EXPECT_EQ(best.view, "thing.pcd");
  const Eigen::Vector3f center = T_scene_thing * twoObjects()->views[0].center();
  EXPECT_LT((best.position() - center.cast<double>()).norm(), 0.01);
  EXPECT_LT(test::angleDegrees(best.T_scene_model.linear(), T_scene_thing.linear().cast<double>()), 3);
  EXPECT_EQ(best.box_size, twoObjects()->views[0].extent().cast<double>());
  EXPECT_GT(best.score, 0.5);
  EXPECT_LT(best.score, 1);
  EXPECT_GE(best.votes, best.inliers);
  for (std::size_t i = 1; i < result.detections.size(); ++i) {
    const Detection& other = result.detections[i];
    EXPECT_LE(other.score, result.detections[i - 1].score);
    EXPECT_LT(other.inliers, best.inliers / 4) << other.object;  // a dozen fit by chance on some processors
  }
  EXPECT_EQ(result.counts.hypotheses, result.detections.size());
  EXPECT_GE(result.times.total, result.times.descriptors);
}

TEST_P(SceneMethod, WorksOnSelectedKeypoints) {
  Settings settings;
  settings.keypoints.discard = 0.5;
  const DetectionResult result = detect(settings);
  EXPECT_EQ(result.counts.keypoints, result.counts.grid_keypoints - result.counts.grid_keypoints / 2);
  ASSERT_FALSE(result.detections.empty());
  EXPECT_EQ(result.detections.front().object, "thing");
}

TEST_P(SceneMethod, IsDeterministic) {
  Settings settings = wholeGrid();
  settings.threads = 1;
  const auto expected = detect(settings).detections;
  for (const int threads : {1, 3}) {
    settings.threads = threads;
    const auto found = detect(settings).detections;
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].score, expected[i].score);
      EXPECT_EQ(found[i].T_scene_model.matrix(), expected[i].T_scene_model.matrix());
    }
  }
}

TEST_P(SceneMethod, FindsNothingWhereNothingCanBeDescribed) {
  const auto detect = makeDetect(GetParam(), twoObjects(), wholeGrid(), MethodSettings());
  EXPECT_TRUE(detect(test::randomCloud(50, 5, 3)).detections.empty());
}

INSTANTIATE_TEST_SUITE_P(Baselines, SceneMethod, ::testing::Values("tombari", "chen", "aldoma", "zhou"),
                         [](const auto& tested) { return std::string(tested.param); });

Settings shapeSettings() {
  Settings settings = wholeGrid();
  settings.surface.normal_radius = 0.015;
  settings.keypoints.grid_size = 0.03;
  settings.descriptor.radius = 0.08;
  settings.voting.min_votes = 1;
  return settings;
}

constexpr float spacing = 0.006f;

std::shared_ptr<const Codebook> shapes() {
  static const auto codebook = std::make_shared<const Codebook>(
      train({sampleOf("blocks", test::model(test::asymmetricShape(), spacing), ViewKind::model),
             sampleOf("potato", test::model(test::roundedShape(), spacing), ViewKind::model),
             sampleOf("cup", test::model(test::cupShape(), spacing), ViewKind::model)},
            shapeSettings(), "shapes"));
  return codebook;
}

class IsolatedMethod : public ::testing::TestWithParam<const char*> {
protected:
  static Classification classify(const char* method, const test::Shape& shape, int threads = 0) {
    Settings settings = shapeSettings();
    settings.threads = threads;
    const Cloud cloud = test::transformed(test::model(shape, spacing), poseOf(70, {1, 2, -1}, {0.03f, 0.01f, -0.02f}));
    return makeClassify(method, shapes(), settings, MethodSettings(), ViewKind::model)(cloud);
  }
};

TEST_P(IsolatedMethod, NamesTurnedModels) {
  EXPECT_EQ(classify(GetParam(), test::asymmetricShape()).object(), "blocks");
  EXPECT_EQ(classify(GetParam(), test::roundedShape()).object(), "potato");
  EXPECT_EQ(classify(GetParam(), test::cupShape()).object(), "cup");
}

TEST_P(IsolatedMethod, IsDeterministicAndSharesAddUpToOne) {
  const Classification one = classify(GetParam(), test::cupShape(), 1),
                       more = classify(GetParam(), test::cupShape(), 3);
  ASSERT_EQ(one.candidates.size(), more.candidates.size());
  double sum = 0;
  for (std::size_t i = 0; i < one.candidates.size(); ++i) {
    EXPECT_EQ(one.candidates[i].object, more.candidates[i].object);
    EXPECT_EQ(one.candidates[i].score, more.candidates[i].score);
    sum += one.candidates[i].score;
  }
  EXPECT_NEAR(sum, 1, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Baselines, IsolatedMethod, ::testing::Values("tombari", "chen", "zhou", "knopp", "seib"),
                         [](const auto& tested) { return std::string(tested.param); });

// PCL's RANSAC tells correspondences apart by the model's keypoint alone.
TEST(FramedModels, GivesEachMatchAKeypointOfItsOwn) {
  const auto codebook = twoObjects();
  const std::uint32_t last = std::uint32_t(codebook->words.size() - 1);
  const std::vector<Match> matches{{0, 1, 0.2f}, {1, 1, 0.3f}, {2, 1, 0.4f}, {3, last, 0.1f}, {4, last, 0.1f}};
  const auto models = baselines::FramedModels(*codebook).matched(*codebook, matches);
  ASSERT_EQ(models.size(), 1u);  // two matches are too few for a pose
  EXPECT_EQ(models[0].object, 0u);
  EXPECT_EQ(models[0].words, (std::vector<std::uint32_t>{1, 1, 1}));
  EXPECT_EQ(models[0].keypoints.position(2), codebook->words[1].position.cast<double>());
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ((*models[0].correspondences)[std::size_t(i)].index_query, i);
    EXPECT_EQ((*models[0].correspondences)[std::size_t(i)].index_match, i);
  }
}

TEST(FramedModels, PoolsViewsThatShareAFrame) {
  Codebook codebook;
  codebook.objects = {"a", "b"};
  codebook.views.resize(4);
  for (int i = 0; i < 3; ++i) codebook.views[std::size_t(i)].frame = "mesh";
  codebook.views[2].object = 1;  // the same name of a frame, but of another object
  for (std::uint32_t view : {0, 1, 2, 3})
    codebook.words.push_back({view, Eigen::Vector3f::Zero(), Eigen::Matrix3f::Identity()});
  std::vector<Match> matches;
  for (std::uint32_t row = 0; row < 12; ++row) matches.push_back({row, row % 4, 0.1f});
  const auto models = baselines::FramedModels(codebook).matched(codebook, matches);
  ASSERT_EQ(models.size(), 3u);
  EXPECT_EQ(models[0].words.size(), 6u);
  EXPECT_EQ(models[1].object, 1u);
  EXPECT_EQ(models[2].words, (std::vector<std::uint32_t>{3, 3, 3}));
}

TEST(Baselines, RefuseSettingsOfAnotherCodebook) {
  Settings settings = wholeGrid();
  settings.descriptor.radius = 0.06;
  EXPECT_THAT(errorOf(ErrorCode::incompatible, [&] { makeDetect("chen", twoObjects(), settings, {}); }),
              HasSubstr("descriptor.radius = 0.05 (not 0.06)"));
  EXPECT_THAT(
      errorOf(ErrorCode::incompatible, [&] { makeClassify("knopp", twoObjects(), settings, {}, ViewKind::view); }),
      HasSubstr("descriptor.radius = 0.05 (not 0.06)"));
}

}  // namespace
}  // namespace sks

#endif
