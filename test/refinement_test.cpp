// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/refinement.hpp"

#include <gtest/gtest.h>

#include "prepared.hpp"
#include "synthetic.hpp"

namespace sks::test {
namespace {

/// A full model, and what a camera sees of it at a pose.
class Refinement : public ::testing::Test {
protected:
  Refinement() : scene_(prepared(view({{asymmetricShape(), T_scene_model_}}), Orientation::sensor)) {
    const Surface model_surface = prepared(model(asymmetricShape(), 0.005f), Orientation::outward);
    for (std::size_t i = 0; i < model_surface.size(); ++i) {
      points_.push_back(model_surface.point(i));
      normals_.push_back(model_surface.normal(i));
    }
  }

  const Eigen::Isometry3f T_scene_model_ = poseOf(70, {1, 2, 0.5f}, {0.05f, -0.02f, 0.8f});
  Surface scene_;
  std::vector<Eigen::Vector3f> points_, normals_;
};

TEST_F(Refinement, BringsARoughPoseToTheTrueOne) {
  const Eigen::Isometry3d truth = T_scene_model_.cast<double>();
  const Eigen::Isometry3d rough = truth * poseOf(6, {0.2f, -1, 0.4f}, {0.006f, -0.004f, 0.005f}).cast<double>();

  const Eigen::Isometry3d refined = refinePose(points_, normals_, scene_, RefinementSettings(), rough);

  EXPECT_GT(angleDegrees(rough.linear(), truth.linear()), 5.9);
  EXPECT_LT(angleDegrees(refined.linear(), truth.linear()), 0.5);
  EXPECT_LT((refined.translation() - truth.translation()).norm(), 0.001);
}

TEST_F(Refinement, KeepsATruePose) {
  const Eigen::Isometry3d truth = T_scene_model_.cast<double>();
  const Eigen::Isometry3d refined = refinePose(points_, normals_, scene_, RefinementSettings(), truth);
  EXPECT_LT(angleDegrees(refined.linear(), truth.linear()), 0.3);
  EXPECT_LT((refined.translation() - truth.translation()).norm(), 0.0005);
}

TEST_F(Refinement, LeavesAPoseThatTouchesNothingAsItIs) {
  Eigen::Isometry3d far = T_scene_model_.cast<double>();
  far.translation().x() += 3;
  EXPECT_TRUE(refinePose(points_, normals_, scene_, RefinementSettings(), far).isApprox(far, 0));
}

TEST_F(Refinement, StaysInPlaceAlongAPlaneThatDoesNotDetermineIt) {
  const Surface flat = prepared(plane(0.4f, 0.003f), Orientation::sensor);
  std::vector<Eigen::Vector3f> points, normals;
  for (std::size_t i = 0; i < flat.size(); ++i) {
    if (flat.point(i).head<2>().norm() > 0.08f) continue;
    points.push_back(flat.point(i));
    normals.push_back(flat.normal(i));
  }
  const Eigen::Isometry3d lifted = poseOf(0, {0, 0, 1}, {0.02f, 0.01f, -0.004f}).cast<double>();

  const Eigen::Isometry3d refined = refinePose(points, normals, flat, RefinementSettings(), lifted);

  EXPECT_NEAR(refined.translation().z(), 0, 1e-4);
  EXPECT_LT((refined.translation() - lifted.translation()).head<2>().norm(), 0.002);
  EXPECT_LT(angleDegrees(refined.linear(), Eigen::Matrix3d::Identity()), 0.5);
}

}  // namespace
}  // namespace sks::test
