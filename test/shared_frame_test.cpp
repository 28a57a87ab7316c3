// SPDX-License-Identifier: BSD-3-Clause
// Views that are registered to each other: one frame, one box, one pose.
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/codebook_file.hpp>
#include "core/voting/hough_hypotheses.hpp"

#include "bumps.hpp"
#include "error_of.hpp"
#include "evaluation/scene_matching.hpp"
#include "io/dataset.hpp"
#include "synthetic.hpp"
#include "temporary_folder.hpp"

namespace sks {
namespace {

using ::testing::HasSubstr;

/// One object with two views, ten words each.
Codebook twoViews(const std::string& frame) {
  Codebook book;
  book.objects = {"thing"};
  book.views.resize(2);
  for (std::uint32_t v = 0; v < 2; ++v) {
    book.views[v].source = "view" + std::to_string(v);
    book.views[v].frame = frame;
    book.views[v].box_min = Eigen::Vector3f(-0.1f, -0.1f, -0.1f);
    book.views[v].box_max = Eigen::Vector3f(0.1f, 0.1f, 0.1f);
    for (const auto& position : test::randomCloud(10, 0.1f, v + 1).points) {
      Codeword word;
      word.view = v;
      word.position = position;
      book.words.push_back(word);
    }
  }
  return book;
}

std::vector<Vote> votesFor(const Codebook& book, const std::vector<std::uint32_t>& words, const Eigen::Isometry3f& T) {
  std::vector<Vote> votes;
  for (const std::uint32_t word : words) {
    votes.push_back({T.translation(), T.linear(), T * book.words[word].position, word, 0, 1});
  }
  return votes;
}

Maximum maximumOf(const std::vector<Vote>& votes) {
  Maximum maximum;
  maximum.position = votes.front().position;
  maximum.votes.resize(votes.size());
  std::iota(maximum.votes.begin(), maximum.votes.end(), 0u);
  return maximum;
}

TEST(SharedFrame, PairsOfAllItsViewsAgreeOnOnePose) {
  const Eigen::Isometry3f T = test::poseOf(50, {1, 2, 0}, {0.3f, 0, 1});
  Hypothesis hypothesis;
  const std::vector<std::uint32_t> words = {0, 1, 10, 11};  // two of each view: too few for either alone
  const Codebook apart = twoViews(""), together = twoViews("thing.obj");
  EXPECT_FALSE(
      estimateHypothesis(apart, 0, votesFor(apart, words, T), maximumOf(votesFor(apart, words, T)), {}, hypothesis));
  const auto votes = votesFor(together, words, T);
  ASSERT_TRUE(estimateHypothesis(together, 0, votes, maximumOf(votes), {}, hypothesis));
  EXPECT_EQ(hypothesis.inliers.size(), 4u);
  EXPECT_LT((hypothesis.T_scene_model.matrix() - T.matrix().cast<double>()).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(SharedFrame, InliersTurnTheModelAsThePoseDoes) {
  const Eigen::Isometry3f T = test::poseOf(50, {1, 2, 0}, {0.3f, 0, 1});
  const Codebook book = twoViews("thing.obj");
  auto votes = votesFor(book, {0, 1, 2, 10, 11, 12}, T);
  votes[4].rotation = votes[4].rotation * Eigen::AngleAxisf(1.0f, Eigen::Vector3f::UnitX());
  Hypothesis hypothesis;
  ASSERT_TRUE(estimateHypothesis(book, 0, votes, maximumOf(votes), {}, hypothesis));
  EXPECT_THAT(hypothesis.inliers, ::testing::ElementsAre(0, 1, 2, 3, 5));
}

TEST(SharedFrame, IsTrainedStoredAndNamed) {
  TrainingSample sample;
  sample.object = "bumps";
  sample.source = "bumps.obj#0";
  sample.frame = "bumps.obj";
  sample.box = Eigen::AlignedBox3f(Eigen::Vector3f(-1, -2, -3), Eigen::Vector3f(3, 2, 1));
  sample.load = [] { return test::bumps(); };
  const Codebook trained = train({sample}, {}, "toys");
  const test::TemporaryFolder folder;
  writeCodebook(folder.path("a.sks"), trained);
  const TrainingView view = readCodebook(folder.path("a.sks"))->views.at(0);
  EXPECT_EQ(view.frame, "bumps.obj");
  EXPECT_EQ(view.frameName(), "bumps.obj");
  EXPECT_EQ(view.center(), Eigen::Vector3f(1, 0, -1));
  EXPECT_EQ(twoViews("").views[1].frameName(), "view1");
}

class MeshEntry : public ::testing::Test {
protected:
  DataSet load(const std::string& training) const {
    test::writeFile(folder_.path("a.obj"), "v 0 0 0\n");
    test::writeFile(folder_.path("s.pcd"), "");
    test::writeFile(folder_.path("d.yaml"), "name: a\nunits: m\nmax_distance: 0.05\ntraining:\n  - {" + training +
                                                "}\nscenes:\n  - name: s\n    cloud: s.pcd\n    objects:\n"
                                                "      - {object: a, position: [0, 0, 1], reference: a.obj}\n");
    return loadDataSet(folder_.path("d.yaml"));
  }
  std::string refusal(const std::string& training) const {
    return test::errorOf(ErrorCode::bad_data, [&] { load(training); });
  }

  test::TemporaryFolder folder_;
};

TEST_F(MeshEntry, GivesItsSymmetryToTheTruth) {
  const DataSet turned = load("object: a, cloud: a.obj, kind: mesh, symmetry: {axis: [0, 0, 2], order: inf}");
  EXPECT_TRUE(turned.training[0].mesh);
  ASSERT_TRUE(turned.scenes[0].objects[0].symmetry);
  EXPECT_EQ(turned.scenes[0].objects[0].symmetry->axis, Eigen::Vector3d::UnitZ());
  EXPECT_EQ(turned.scenes[0].objects[0].symmetry->order, 0);
  EXPECT_EQ(
      load("object: a, cloud: a.obj, kind: mesh, symmetry: {axis: [1, 0, 0], order: 4}").training[0].symmetry->order,
      4);
  EXPECT_FALSE(load("object: a, cloud: a.obj, kind: mesh").scenes[0].objects[0].symmetry);
}

TEST_F(MeshEntry, IsRefusedWithTheReason) {
  EXPECT_THAT(refusal("object: a, cloud: a.obj, kind: mesh, symmetry: {axis: [0, 0, 0], order: 2}"),
              HasSubstr("'axis'"));
  EXPECT_THAT(refusal("object: a, cloud: a.obj, kind: mesh, symmetry: {axis: [0, 0, 1], order: 1.5}"),
              HasSubstr("whole number from 2 to 1000, or inf"));
  EXPECT_THAT(refusal("object: a, cloud: 'builtin:mug', kind: view"),
              HasSubstr("must be mesh for the built-in object"));
}

TEST_F(MeshEntry, IsRenderedByTheSampler) {
  const DataSet data_set = load("object: a, cloud: a.obj, kind: mesh");
  EXPECT_THAT(test::errorOf(ErrorCode::bad_usage, [&] { trainingSamples(data_set); }),
              HasSubstr("cannot train from meshes"));
  const auto sampler = [](const TrainingEntry& entry, double) {
    TrainingSample sample;
    sample.source = entry.source + "#0";
    return std::vector<TrainingSample>{sample, sample};
  };
  const auto samples = trainingSamples(data_set, sampler);
  ASSERT_EQ(samples.size(), 2u);
  EXPECT_EQ(samples[1].source, "a.obj#0");
}

TEST(SymmetricPoseError, IsThatToTheNearestTurn) {
  const Eigen::Isometry3d truth = test::poseOf(70, {1, 0, 2}, {0.1f, 0.2f, 1}).cast<double>();
  const Eigen::Vector3d center(0.02, 0.01, 0.1), axis = Eigen::Vector3d::UnitZ();
  const auto turned = [&](double degrees) {
    return Eigen::Isometry3d(truth * Eigen::Translation3d(center) * Eigen::AngleAxisd(degrees * EIGEN_PI / 180, axis) *
                             Eigen::Translation3d(-center));
  };
  const auto error = [&](double degrees, const std::optional<Symmetry>& symmetry) {
    return poseError(turned(degrees), truth, truth * center, symmetry);
  };
  EXPECT_NEAR(error(100, {}).rotation, 100, 1e-4);
  EXPECT_NEAR(error(100, Symmetry{axis, 0}).rotation, 0, 1e-4);
  EXPECT_NEAR(error(100, Symmetry{axis, 0}).t_diff, 0, 1e-4);
  EXPECT_NEAR(error(100, Symmetry{axis, 4}).rotation, 10, 1e-4);
  EXPECT_NEAR(error(-170, Symmetry{axis, 2}).rotation, 10, 1e-4);
  EXPECT_NEAR(error(100, Symmetry{Eigen::Vector3d::UnitX(), 2}).rotation, 100, 1e-4);
}

}  // namespace
}  // namespace sks
