// SPDX-License-Identifier: BSD-3-Clause
#include "core/voting/hough_hypotheses.hpp"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "core/verification/hough_verifier.hpp"
#include "synthetic.hpp"

namespace {

/// Two objects; the second has two views whose boxes lie far from the origin.
sks::Codebook codebook() {
  sks::Codebook book;
  book.objects = {"other", "thing"};
  book.views.resize(3);
  for (std::uint32_t v = 0; v < 3; ++v) {
    sks::TrainingView& view = book.views[v];
    view.object = v == 0 ? 0 : 1;
    view.box_min = Eigen::Vector3f(0.5f, -1, 2 + float(v));
    view.box_max = view.box_min + Eigen::Vector3f(0.2f, 0.1f, 0.3f + 0.1f * float(v));
    for (const auto& offset : sks::test::randomCloud(30, 0.1f, v + 1).points) {
      sks::Codeword word;
      word.view = v;
      word.position = view.center() + offset;
      book.words.push_back(word);
    }
  }
  return book;
}

/// The vote of a word for its view's centre under T.
sks::Vote voteOf(const sks::Codebook& book, std::uint32_t word, const Eigen::Isometry3f& T) {
  sks::Vote vote;
  vote.word = word;
  vote.keypoint = T * book.words[word].position;
  vote.position = T * book.views[book.words[word].view].center();
  vote.rotation = T.linear();
  vote.distance = 0;
  return vote;
}

sks::Maximum maximumOf(const std::vector<sks::Vote>& votes, const Eigen::Vector3f& position) {
  sks::Maximum maximum;
  maximum.position = position;
  maximum.votes.resize(votes.size());
  std::iota(maximum.votes.begin(), maximum.votes.end(), 0u);
  maximum.density = double(votes.size());
  return maximum;
}

}  // namespace

// Traps 5, 6 and 12: the pose is the model's, the identity included; the box lies at the model's box.
TEST(Hypothesis, HasThePoseOfTheModelAndTheCenterOfItsBox) {
  const sks::Codebook book = codebook();
  for (const auto& T :
       {Eigen::Isometry3f(Eigen::Isometry3f::Identity()), sks::test::poseOf(100, {1, 0.3f, -2}, {0.2f, 0.4f, -0.6f})}) {
    std::vector<sks::Vote> votes;
    for (std::uint32_t word = 30; word < 50; ++word) votes.push_back(voteOf(book, word, T));
    for (std::uint32_t i = 0; i < votes.size(); i += 4) votes[i].keypoint += Eigen::Vector3f(0.3f, 0.2f * float(i), 0);
    const sks::Maximum maximum = maximumOf(votes, T * book.views[1].center());
    sks::Hypothesis hypothesis;
    ASSERT_TRUE(sks::estimateHypothesis(book, 1, votes, maximum, {}, hypothesis));
    EXPECT_EQ(hypothesis.object, 1u);
    EXPECT_EQ(hypothesis.view, 1u);
    EXPECT_LT((hypothesis.T_scene_model.matrix() - T.matrix().cast<double>()).cwiseAbs().maxCoeff(), 1e-5);
    EXPECT_LT((hypothesis.T_scene_box.translation() - (T * book.views[1].center()).cast<double>()).norm(), 1e-5);
    EXPECT_LT((hypothesis.T_scene_box.linear() - hypothesis.T_scene_model.linear()).norm(), 1e-9);
    EXPECT_LT((hypothesis.box_size - Eigen::Vector3d(0.2, 0.1, 0.4)).norm(), 1e-6);
    EXPECT_EQ(hypothesis.votes, 20u);
    EXPECT_EQ(hypothesis.inliers.size(), 15u);
    for (const std::uint32_t i : hypothesis.inliers) EXPECT_NE(i % 4, 0u);
    EXPECT_NEAR(hypothesis.density, 15, 1e-3);  // of the inliers' votes alone
  }
}

TEST(Hypothesis, ComparesPairsWithinOneViewAndTakesTheViewWithMostInliers) {
  const sks::Codebook book = codebook();
  const Eigen::Isometry3f T1 = sks::test::poseOf(30, {0, 1, 0}, {0, 0, 0});
  Eigen::Isometry3f T2 = sks::test::poseOf(80, {1, 1, 0}, {0, 0, 0});  // another frame, the same centre in the scene
  T2.translation() = T1 * book.views[1].center() - T2 * book.views[2].center();
  std::vector<sks::Vote> votes;
  for (std::uint32_t word = 30; word < 36; ++word) votes.push_back(voteOf(book, word, T1));
  for (std::uint32_t word = 60; word < 70; ++word) votes.push_back(voteOf(book, word, T2));
  sks::Hypothesis hypothesis;
  ASSERT_TRUE(sks::estimateHypothesis(book, 1, votes, maximumOf(votes, votes[0].position), {}, hypothesis));
  EXPECT_EQ(hypothesis.view, 2u);
  EXPECT_EQ(hypothesis.inliers.size(), 16u);
  EXPECT_LT((hypothesis.T_scene_model.matrix() - T2.matrix().cast<double>()).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_NEAR(hypothesis.density, 16, 1e-3);
  EXPECT_NEAR(hypothesis.evidence, std::sqrt(16 * 10), 1e-3);  // ten of them speak for the pose
}

TEST(Hypothesis, OfASmallViewScoresMoreByTheSameVotes) {
  sks::Codebook book = codebook();  // 30 codewords a view
  for (int i = 0; i < 240; ++i) book.words.push_back(book.words.back());
  const sks::HoughVerifier verifier(book);
  sks::Settings settings;
  settings.detection.half_density = 8;
  sks::Hypothesis hypothesis;
  hypothesis.evidence = 8;
  hypothesis.view = 2;  // 270 codewords
  EXPECT_DOUBLE_EQ(verifier.score(hypothesis, settings), 0.5);
  hypothesis.view = 1;
  EXPECT_NEAR(verifier.score(hypothesis, settings), 1 / (1 + std::pow(30 / 270.0, 0.6)), 1e-9);
}

TEST(Hypothesis, NeedsEnoughInliers) {
  const sks::Codebook book = codebook();
  std::vector<sks::Vote> votes;
  for (std::uint32_t word = 30; word < 36; ++word) votes.push_back(voteOf(book, word, Eigen::Isometry3f::Identity()));
  const sks::Maximum maximum = maximumOf(votes, votes[0].position);
  sks::Settings settings;
  sks::Hypothesis hypothesis;
  settings.ransac.min_inliers = 6;
  EXPECT_TRUE(sks::estimateHypothesis(book, 1, votes, maximum, settings, hypothesis));
  settings.ransac.min_inliers = 7;
  EXPECT_FALSE(sks::estimateHypothesis(book, 1, votes, maximum, settings, hypothesis));
  settings.ransac.min_inliers = 3;
  const std::vector<sks::Vote> two(votes.begin(), votes.begin() + 2);
  EXPECT_FALSE(sks::estimateHypothesis(book, 1, two, maximumOf(two, two[0].position), settings, hypothesis));
}

TEST(Hypothesis, ReadsOnlyTheVotesOfItsMaximum) {
  const sks::Codebook book = codebook();
  std::vector<sks::Vote> votes;
  for (std::uint32_t word = 30; word < 50; ++word) votes.push_back(voteOf(book, word, Eigen::Isometry3f::Identity()));
  sks::Maximum maximum = maximumOf(votes, votes[0].position);
  maximum.votes = {1, 5, 9, 13};
  sks::Hypothesis hypothesis;
  ASSERT_TRUE(sks::estimateHypothesis(book, 1, votes, maximum, {}, hypothesis));
  EXPECT_EQ(hypothesis.inliers, maximum.votes);
  EXPECT_EQ(hypothesis.votes, 4u);
  EXPECT_NEAR(hypothesis.density, 4, 1e-3);
}
