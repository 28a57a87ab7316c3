// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/stages/voting.hpp>

#include <gtest/gtest.h>

#include "synthetic.hpp"

namespace {

Eigen::Matrix3f frameOf(float degrees, const Eigen::Vector3f& axis) {
  return sks::test::poseOf(degrees, axis, Eigen::Vector3f::Zero()).linear();
}

sks::Codebook twoTargets() {
  sks::Codebook codebook;
  codebook.objects = {"mug", "box"};
  codebook.views.resize(3);
  for (std::uint32_t i = 0; i < 3; ++i) {
    codebook.views[i].object = i == 1 ? 0 : 1;  // box, mug, box
    codebook.views[i].box_min = Eigen::Vector3f(1, 2, 3) + float(i) * Eigen::Vector3f::Ones();
    codebook.views[i].box_max = codebook.views[i].box_min + Eigen::Vector3f(0.2f, 0.3f, 0.4f);
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    sks::Codeword word;
    word.view = i % 3;
    word.position = codebook.views[word.view].box_min + 0.03f * float(i) * Eigen::Vector3f(1, 0.5f, 0.2f);
    word.frame = frameOf(50.0f * float(i), {1, float(i), 2});
    codebook.words.push_back(word);
  }
  return codebook;
}

}  // namespace

// Equations 1 and 2: for a scene that is the model moved by T, every correspondence votes for T times the box centre.
// Trap 12: that is what the centre vector points to, however far the model's origin lies away.
TEST(Voting, CorrespondencesOfAMovedModelVoteForItsBoxCenter) {
  const sks::Codebook codebook = twoTargets();
  for (const auto& T :
       {sks::test::poseOf(0, {0, 0, 1}, {0, 0, 0}), sks::test::poseOf(75, {1, -2, 0.5f}, {0.3f, -1, 2})}) {
    sks::Descriptors descriptors;
    sks::Keypoints keypoints;
    std::vector<sks::Match> matches;
    for (std::uint32_t i = 0; i < codebook.words.size(); ++i) {
      // Keypoints in reverse, to tell the indices of keypoints, descriptors and words apart.
      const std::uint32_t word = std::uint32_t(codebook.words.size()) - 1 - i;
      keypoints.positions.insert(keypoints.positions.begin(), T * codebook.words[word].position);
      descriptors.frames.push_back(codebook.words[word].frame * T.linear().transpose());
      descriptors.keypoints.push_back(std::uint32_t(codebook.words.size()) - 1 - i);
      matches.push_back({i, word, 0.25f});
    }
    const auto spaces = sks::castVotes(codebook, matches, descriptors, keypoints);
    ASSERT_EQ(spaces.size(), 2u);  // one Hough space per class
    EXPECT_EQ(spaces[0].size(), 2u);
    EXPECT_EQ(spaces[1].size(), 4u);
    for (std::uint32_t object = 0; object < 2; ++object) {
      for (const sks::Vote& vote : spaces[object]) {
        const sks::Codeword& word = codebook.words[vote.word];
        const sks::TrainingView& view = codebook.views[word.view];
        EXPECT_EQ(view.object, object);
        EXPECT_LT((vote.position - T * view.center()).norm(), 1e-5f);
        EXPECT_LT((vote.rotation - T.linear()).norm(), 1e-5f);
        EXPECT_LT((vote.keypoint - T * word.position).norm(), 1e-6f);
        EXPECT_EQ(vote.distance, 0.25f);
      }
    }
  }
}

// Trap 3: no rule drops votes, however far a match's distance or its vote lies from the others.
TEST(Voting, KeepsTheVotesOfAllMatchesInTheirOrder) {
  const sks::Codebook codebook = twoTargets();
  sks::Descriptors descriptors;
  sks::Keypoints keypoints;
  std::vector<sks::Match> matches;
  for (std::uint32_t i = 0; i < 500; ++i) {
    keypoints.positions.emplace_back(float(i) * 0.7f, float(i % 13), 1.0f);
    descriptors.keypoints.push_back(i);
    descriptors.frames.push_back(frameOf(float(i * 17), {1, 1, float(i)}));
    matches.push_back({i, i % 6, i % 3 ? float(i) : 0.0f});
  }
  const auto spaces = sks::castVotes(codebook, matches, descriptors, keypoints);
  EXPECT_EQ(spaces[0].size() + spaces[1].size(), 500u);
  for (const auto& space : spaces) {
    for (std::size_t i = 1; i < space.size(); ++i) EXPECT_LT(space[i - 1].keypoint.x(), space[i].keypoint.x());
  }
}

TEST(Voting, WithoutMatchesEverySpaceIsEmpty) {
  const auto spaces = sks::castVotes(twoTargets(), {}, {}, {});
  ASSERT_EQ(spaces.size(), 2u);
  EXPECT_TRUE(spaces[0].empty() && spaces[1].empty());
}
