// SPDX-License-Identifier: BSD-3-Clause
// Objects with a body of revolution are found with the right turn, wherever their handle or their print is seen.
#include <memory>

#include <gtest/gtest.h>

#include <sks_detector/detector.hpp>
#include <sks_detector/simulation/camera_presets.hpp>
#include <sks_detector/trainer.hpp>

#include "simulation/builtin_objects.hpp"
#include "simulation/renderer.hpp"
#include "synthetic.hpp"
#include "table_scene.hpp"

namespace sks {
namespace {

constexpr double degree = double(EIGEN_PI) / 180;
constexpr int threads = 4;

TEST(BodyTurn, OfAMugIsRightFromAllAround) {
  const auto mug = std::make_shared<const Mesh>(builtinObject("mug"));
  const auto codebook = std::make_shared<Codebook>(train(meshSamples("mug", "mug", mug, {}), {}, "mug"));
  const Detector detector(codebook);
  Renderer renderer;
  test::addTable(renderer);
  renderer.addInstance(renderer.addMesh(mug), test::standingPose(*mug));
  const Eigen::Vector3d middle(0, 0, 0.5 * double(mug->box().sizes().z()));
  const int pictures = 12;
  int right = 0;
  for (int i = 0; i < pictures; ++i) {
    const Eigen::Isometry3d T_table_camera =
        test::cameraAt(middle, 360.0 * i / pictures + 7, (25 + i % 3 * 10) * degree, 0.7);
    const Cloud cloud = renderer.render(cameraPreset("kinect"), T_table_camera, std::uint64_t(i), threads).cloud;
    const auto found = detector.detect(cloud).above(0.5);
    ASSERT_FALSE(found.empty()) << i;
    const Eigen::Isometry3d T_table_mug = T_table_camera * found[0].T_scene_model;
    const Eigen::Vector3d center = found[0].T_scene_model.inverse() * found[0].T_scene_box.translation();
    EXPECT_LT((center - mug->box().center().cast<double>()).norm(), 0.001) << i;  // the box is turned as well
    right += test::angleDegrees(T_table_mug.linear(), test::standingPose(*mug).linear()) < 5 ? 1 : 0;
  }
  EXPECT_GE(right, pictures - 1);  // the handle is out of sight in a third of them: there a spot opposite of it tells
}

}  // namespace
}  // namespace sks
