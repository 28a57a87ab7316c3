// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/projective_refinement.hpp"

#include <gtest/gtest.h>

#include "prepared.hpp"
#include "synthetic.hpp"
#include "training_samples.hpp"

namespace sks::test {
namespace {

const Eigen::Isometry3f T_scene_bumps = poseOf(35, {1, 2, 0.5f}, {0, 0, 0.8f});

/// A training view whose frame is the camera's: its true pose in the scene is the identity.
class ProjectiveRefinement : public ::testing::Test {
protected:
  ProjectiveRefinement()
      : codebook_(train({sampleOf("thing", view({{asymmetricShape(), T_scene_bumps}}))}, Settings(), "synthetic")),
        surface_(prepared(view({{asymmetricShape(), T_scene_bumps}}, 0.0025f, 240, 200))),
        scene_(surface_, Settings()) {}

  Eigen::Isometry3d refined(const Eigen::Isometry3d& rough) const {
    return refineAlongRays(codebook_.views.at(0), scene_, RefinementSettings(), rough);
  }

  Codebook codebook_;
  Surface surface_;
  SceneView scene_;
};

TEST_F(ProjectiveRefinement, BringsARoughPoseToTheTrueOne) {
  const Eigen::Vector3d center = codebook_.views.at(0).center().cast<double>();
  const Eigen::Isometry3d turn = poseOf(6, {0.2f, -1, 0.4f}, {0.006f, -0.004f, 0.005f}).cast<double>();
  const Eigen::Isometry3d rough = Eigen::Translation3d(center) * turn * Eigen::Translation3d(-center);
  const Eigen::Isometry3d found = refined(rough);
  EXPECT_GT(angleDegrees(rough.linear(), Eigen::Matrix3d::Identity()), 5.9);
  EXPECT_LT(angleDegrees(found.linear(), Eigen::Matrix3d::Identity()), 0.5);
  EXPECT_LT((found * center - center).norm(), 0.001);
}

TEST_F(ProjectiveRefinement, LeavesAPoseThatTouchesNothingAsItIs) {
  const Eigen::Isometry3d far(Eigen::Translation3d(3, 0, 0));
  EXPECT_TRUE(refined(far).isApprox(far, 0));
}

}  // namespace
}  // namespace sks::test
