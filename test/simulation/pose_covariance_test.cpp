// SPDX-License-Identifier: BSD-3-Clause
// The covariance of a pose, checked against the errors of poses before a virtual camera.
#include "core/verification/pose_information.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Cholesky>

#include <sks_detector/detector.hpp>
#include <sks_detector/simulation/camera_presets.hpp>
#include <sks_detector/simulation/training_views.hpp>
#include <sks_detector/trainer.hpp>

#include "simulation/builtin_objects.hpp"
#include "simulation/renderer.hpp"
#include "table_scene.hpp"

namespace sks {
namespace {

constexpr double one_degree = EIGEN_PI / 180;

/// A detection of an object that stands on a table, and the error of its pose.
struct Measured {
  Matrix6d covariance;  // along the axes of the model
  Vector6d error;       // shift of the box's centre, rotation vector

  double squared() const { return error.dot(covariance.ldlt().solve(error)); }
  double deviation(int i) const { return std::sqrt(covariance(i, i)); }
};

std::vector<Measured> measure(const std::string& object, const std::string& camera, int pictures) {
  const auto mesh = std::make_shared<const Mesh>(builtinObject(object));
  const auto codebook = std::make_shared<const Codebook>(train(meshSamples(object, object, mesh, {}), {}, object));
  const Detector detector(codebook);
  Renderer renderer;
  test::addTable(renderer);
  const Eigen::Isometry3d T_table_model = test::standingPose(*mesh);
  renderer.addInstance(renderer.addMesh(mesh), T_table_model);
  const Eigen::Vector3d center = mesh->box().center().cast<double>();
  std::vector<Measured> all;
  for (int i = 0; i < pictures; ++i) {
    const double distance = 0.6 + 0.3 * i / pictures;
    const Eigen::Isometry3d T_table_camera =
        test::cameraAt(T_table_model * center, 360.0 * i / pictures, 0.6, distance);
    const Cloud cloud = renderer.render(cameraPreset(camera), T_table_camera, std::uint64_t(i), 2).cloud;
    const std::vector<Detection> found = detector.detect(cloud).above(0.5);
    if (found.empty()) continue;
    const Eigen::Isometry3d& T_scene_model = found.front().T_scene_model;
    const Eigen::Isometry3d error = (T_table_camera.inverse() * T_table_model).inverse() * T_scene_model;
    const Eigen::AngleAxisd turn(error.linear());
    Measured measured;
    measured.covariance = covarianceInModel(found.front().covariance, T_scene_model, center);
    measured.error << error * center - center, turn.angle() * turn.axis();
    all.push_back(measured);
  }
  return all;
}

TEST(PoseCovariance, NormalizedSquaredErrorsAreThoseOfSixDegreesOfFreedom) {
  constexpr int pictures = 12;
  constexpr double chi_squared_95 = 12.59;  // of six degrees of freedom; its mean is 6
  std::vector<double> squared;
  for (const std::string camera : {"kinect", "xtion", "realsense"}) {
    double sum = 0;
    int count = 0;
    for (const std::string object : {"duck", "drill"}) {
      for (const Measured& measured : measure(object, camera, pictures)) {
        squared.push_back(measured.squared());
        sum += squared.back();
        ++count;
      }
    }
    ASSERT_GE(count, 22) << camera;
    EXPECT_GT(sum / count, 2.5) << camera << ": deviations are told much too large";
    EXPECT_LT(sum / count, 8) << camera << ": deviations are told too small";
  }
  const auto inside = std::count_if(squared.begin(), squared.end(), [&](double s) { return s <= chi_squared_95; });
  EXPECT_GE(double(inside) / double(squared.size()), 0.9);
}

TEST(PoseCovariance, TheTurnOfABottleIsNotKnown) {
  const std::vector<Measured> all = measure("bottle", "kinect", 4);
  ASSERT_FALSE(all.empty());
  for (const Measured& measured : all) {
    EXPECT_LT(measured.deviation(3), 2 * one_degree);
    EXPECT_LT(measured.deviation(4), 2 * one_degree);
    EXPECT_GT(measured.deviation(5), 20 * one_degree);
    EXPECT_LT(measured.deviation(0), 0.01);
    EXPECT_LT(measured.deviation(2), 0.002);
  }
}

TEST(PoseCovariance, InTheSceneItIsThatOfTheOriginOfTheModel) {
  Matrix6d in_model = Matrix6d::Zero();
  in_model(5, 5) = 0.01;  // the turn about z through the centre: 0.1 rad
  Eigen::Isometry3d T_scene_model(Eigen::AngleAxisd(0.5 * EIGEN_PI, Eigen::Vector3d::UnitX()));
  T_scene_model.translation() << 1, 2, 3;
  const Eigen::Vector3d center(0.2, 0, 0.05);
  const Matrix6d in_scene = covarianceInScene(in_model, T_scene_model, center);
  // The model's z is the scene's -y; the origin, 0.2 m from the axis, moves along the model's y: the scene's z.
  EXPECT_NEAR(in_scene(4, 4), 0.01, 1e-12);
  EXPECT_NEAR(in_scene(2, 2), 0.2 * 0.2 * 0.01, 1e-12);
  EXPECT_NEAR(in_scene.trace(), 0.01 + 0.0004, 1e-12);
  EXPECT_LT((covarianceInModel(in_scene, T_scene_model, center) - in_model).norm(), 1e-12);
}

}  // namespace
}  // namespace sks
