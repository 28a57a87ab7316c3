// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/keypoint_study.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/cloud_io.hpp>
#include <sks_detector/error.hpp>

#include "error_of.hpp"
#include "synthetic.hpp"
#include "temporary_folder.hpp"

namespace sks {
namespace {

using test::errorOf;
using ::testing::HasSubstr;

/// Keypoints at given places; the i-th descriptor has its one bin at `bins[i]`.
DescribedKeypoints described(const std::vector<Eigen::Vector3f>& places, const std::vector<std::size_t>& bins) {
  DescribedKeypoints result;
  result.keypoints.positions = places;
  std::vector<float> values(shot_size * bins.size(), 0);
  for (std::size_t i = 0; i < bins.size(); ++i) {
    values[i * shot_size + bins[i]] = 1;
    result.descriptors.keypoints.push_back(std::uint32_t(i));
  }
  result.descriptors.frames.resize(bins.size(), Eigen::Matrix3f::Identity());
  result.descriptors.values = DescriptorMatrix(std::move(values), shot_size);
  return result;
}

TEST(KeypointPairs, CountReciprocalCorrespondencesAndInliers) {
  const std::vector<Eigen::Vector3f> places{{0, 0, 0}, {0.2f, 0, 0}, {0, 0.3f, 0}, {0, 0, 0.4f}, {0.3f, 0.3f, 0}};
  const Eigen::Isometry3f T = test::poseOf(40, {1, 1, 0}, {0.1f, 0.2f, 1});
  std::vector<Eigen::Vector3f> moved;
  for (const Eigen::Vector3f& p : places) moved.push_back(T * p);
  moved[3] += Eigen::Vector3f(0.5f, 0, 0);  // a wrong correspondence
  // the last keypoint's descriptor is that of the first one: only one of the two can be reciprocal
  const KeypointPair pair =
      comparePair(described(places, {1, 2, 3, 4, 1}), described(moved, {1, 2, 3, 4, 7}), RansacSettings(), 1);
  EXPECT_EQ(pair.object_keypoints, 5u);
  EXPECT_EQ(pair.scene_keypoints, 5u);
  EXPECT_EQ(pair.correspondences, 4u);
  EXPECT_EQ(pair.inliers, 3u);
  EXPECT_DOUBLE_EQ(pair.correctFraction(), 0.6);
  ASSERT_TRUE(pair.T_scene_object);
  EXPECT_LT((pair.T_scene_object->matrix() - T.cast<double>().matrix()).norm(), 1e-5);
}

TEST(KeypointPairs, WithoutConsensusHaveNoPose) {
  const KeypointPair pair = comparePair(described({{0, 0, 0}, {1, 0, 0}}, {1, 2}),
                                        described({{0, 0, 0}, {1, 0, 0}}, {1, 2}), RansacSettings(), 1);
  EXPECT_EQ(pair.correspondences, 2u);
  EXPECT_EQ(pair.inliers, 0u);
  EXPECT_FALSE(pair.T_scene_object);
}

/// A view of a shape, and a scene in which the camera has moved aside, with a wall.
class KeypointStudyTest : public ::testing::Test {
protected:
  void SetUp() override {
    const Eigen::Isometry3f T_camera = test::poseOf(0, Eigen::Vector3f::UnitX(), {0, 0, 1});
    const Eigen::Isometry3f T_scene = test::poseOf(20, Eigen::Vector3f::UnitZ(), {0.05f, -0.03f, 1});
    writeCloud(folder_.path("view.pcd"), test::view({{test::asymmetricShape(), T_camera}}));
    writeCloud(folder_.path("scene.pcd"), test::view({{test::asymmetricShape(), T_scene}}));
    TrainingEntry entry;
    entry.object = "blocks";
    entry.source = "view.pcd";
    entry.path = folder_.path("view.pcd");
    data_set_.training.push_back(entry);
    GroundTruth truth;
    truth.object = "blocks";
    truth.reference = "view.pcd";
    truth.T_scene_reference = (T_scene * T_camera.inverse()).cast<double>();
    Scene scene;
    scene.name = "only";
    scene.path = folder_.path("scene.pcd");
    scene.objects = {truth, GroundTruth{"ghost", {0, 0, 3}, "", {}, {}, {}, {}}};
    data_set_.scenes.push_back(scene);
    data_set_.name = "set";
  }

  test::TemporaryFolder folder_;
  DataSet data_set_;
};

TEST_F(KeypointStudyTest, ComparesGridSelectionAndIss) {
  Settings settings;
  settings.keypoints.discard = 0.25;
  const KeypointStudy study = studyKeypoints(data_set_, settings);
  EXPECT_EQ(study.scenes, 1u);
  EXPECT_EQ(study.skipped, 1u);  // the ghost has no pose
  ASSERT_EQ(study.kinds.size(), 3u);
  EXPECT_EQ(study.kinds[0].name, "grid");
  EXPECT_EQ(study.kinds[1].name, "sks-25");
  EXPECT_EQ(study.kinds[2].name, "iss");
  const std::size_t grid = study.kinds[0].pairs.at(0).pair.scene_keypoints;
  EXPECT_EQ(study.kinds[1].pairs.at(0).pair.scene_keypoints, grid - grid / 4);
  for (const StudiedKeypoints& kind : study.kinds) {
    ASSERT_EQ(kind.pairs.size(), 1u);
    EXPECT_EQ(kind.pairs[0].scene, "only");
    EXPECT_EQ(kind.pairs[0].object, "blocks");
    ASSERT_EQ(kind.scene_times.size(), 1u);
    EXPECT_GT(kind.meanTime(), 0);
  }
  const StudiedPair& pair = study.kinds[0].pairs[0];
  ASSERT_TRUE(pair.t_diff);
  EXPECT_LT(*pair.t_diff, 0.1);
  EXPECT_GT(pair.pair.correctFraction(), 0.3);
  EXPECT_DOUBLE_EQ(study.relativeTime(study.kinds[2]), 1);
}

TEST_F(KeypointStudyTest, SaysWhatIsMissing) {
  data_set_.scenes[0].objects.erase(data_set_.scenes[0].objects.begin());
  data_set_.file = "set.yaml";
  EXPECT_THAT(errorOf(ErrorCode::bad_data, [&] { studyKeypoints(data_set_, Settings()); }),
              HasSubstr("'set.yaml' has no pair to compare"));
  SetUp();
  data_set_.training[0].path = folder_.path("absent.pcd");
  data_set_.scenes.erase(data_set_.scenes.begin());
  EXPECT_THAT(errorOf(ErrorCode::bad_file, [&] { studyKeypoints(data_set_, Settings()); }), HasSubstr("absent.pcd"));
}

}  // namespace
}  // namespace sks
