// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/candidate_choice.hpp"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "prepared.hpp"
#include "synthetic.hpp"
#include "training_samples.hpp"

namespace sks::test {
namespace {

const Eigen::Isometry3f T_scene_shape = poseOf(35, {1, 2, 0.5f}, {0, 0, 0.8f});

Eigen::Isometry3d moved(double x, double y, double z, double turn) {
  return Eigen::Translation3d(x, y, z + 0.8) * Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()) *
         Eigen::Translation3d(0, 0, -0.8);
}

class CandidateChoice : public testing::Test {
protected:
  /// Wrong ones all about the object, and one that is a little off.
  std::vector<PoseCandidate> candidates(int wrong) const {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> shift(-0.15, 0.15), turn(1, 5);
    std::vector<PoseCandidate> all(std::size_t(wrong) + 1);
    for (PoseCandidate& candidate : all) {
      candidate.T_scene_model = moved(shift(random), shift(random), shift(random), turn(random));
    }
    all.back().T_scene_model = nearlyRight();
    for (PoseCandidate& candidate : all) candidate.stands = true;
    return all;
  }
  static Eigen::Isometry3d nearlyRight() { return moved(0.006, -0.005, 0.004, 0.1); }

  std::vector<PoseCandidate> chosen(std::vector<PoseCandidate> all, int threads) const {
    return mostPromisingCandidates(std::move(all), examiner_, models_, view_, settings_,
                                   candidatesOfEach(no_votes_, settings_.verification), threads);
  }

  /// Without this no pose is so bad that it goes whatever its place among the others.
  static Settings withoutLeastEvidence() {
    Settings settings;
    settings.verification.half_evidence = 0.001;
    return settings;
  }

  Settings settings_ = withoutLeastEvidence();
  const std::shared_ptr<const Codebook> codebook_ = std::make_shared<const Codebook>(
      train({sampleOf("thing", view({{asymmetricShape(), T_scene_shape}}))}, Settings(), "synthetic"));
  const VerifiedModels models_{codebook_, 1};
  const Surface scene_ =
      prepared(view({{asymmetricShape(), T_scene_shape},
                     {Shape{{Solid::Shape::box, {0, 0, 0}, {0.8f, 0.8f, 0.01f}}}, poseOf(0, {0, 0, 1}, {0, 0, 1.2f})}},
                    0.0025f, 240, 200));
  const SceneView view_{scene_, settings_};
  const std::vector<std::vector<Vote>> no_votes_{1};
  const PoseExaminer examiner_{models_, view_, no_votes_, settings_};
};

TEST_F(CandidateChoice, TheNearlyRightPoseIsBestAndStaysAsItWas) {
  const std::vector<PoseCandidate> kept = chosen(candidates(119), 1);
  EXPECT_LE(kept.size(), std::size_t(0.8 * settings_.verification.candidates));
  EXPECT_TRUE(kept.front().T_scene_model.isApprox(nearlyRight(), 1e-12));
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end(),
                             [](const PoseCandidate& a, const PoseCandidate& b) { return a.pre_score > b.pre_score; }));
}

TEST_F(CandidateChoice, OfHopelesslySmallEvidenceOnlyTheFirstStay) {
  const std::vector<PoseCandidate> before = chosen(candidates(119), 1);
  settings_.verification.half_evidence = 1e9;
  const std::vector<PoseCandidate> kept = chosen(candidates(119), 1);
  EXPECT_EQ(kept.size(), 20u);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    EXPECT_EQ(kept[i].T_scene_model.matrix(), before[i].T_scene_model.matrix());
  }
}

TEST_F(CandidateChoice, FewAreAllKept) {
  EXPECT_EQ(chosen(candidates(15), 1).size(), 16u);
  EXPECT_TRUE(chosen({}, 1).empty());
}

TEST_F(CandidateChoice, FourFifthsOfGoodOnesAreKept) {
  const std::vector<PoseCandidate> good(120, candidates(0).front());
  EXPECT_EQ(chosen(good, 1).size(), std::size_t(0.8 * settings_.verification.candidates));
}

TEST_F(CandidateChoice, IsTheSameForAnyNumberOfThreads) {
  const std::vector<PoseCandidate> one = chosen(candidates(119), 1), many = chosen(candidates(119), 7);
  ASSERT_EQ(one.size(), many.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].pre_score, many[i].pre_score);
    EXPECT_EQ(one[i].T_scene_model.matrix(), many[i].T_scene_model.matrix());
  }
}

}  // namespace
}  // namespace sks::test
