// SPDX-License-Identifier: BSD-3-Clause
// A simulated scene with the notched box among other things, and what a codebook detects in it.
#pragma once

#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include <sks_detector/detector.hpp>
#include <sks_detector/simulation/training_views.hpp>

#include "simulation/notched_box.hpp"
#include "simulation/renderer.hpp"
#include "simulation/scene.hpp"

namespace sks::test {

/// The object with the colours of its sides, without a file.
inline Mesh notchedMesh() {
  Mesh mesh;
  for (const Patch& patch : notchedBox()) {
    const int first = int(mesh.vertices.size());
    for (const Eigen::Vector3i& corner : patch.corners) {
      mesh.vertices.push_back(1e-3f * corner.cast<float>());
      mesh.colors.push_back(side_colors[std::size_t(patch.side)]);
    }
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    mesh.triangles.emplace_back(first, first + 2, first + 3);
  }
  return mesh;
}

/// Few views from near by, so that training takes no time.
inline MeshTraining closeViews() {
  MeshTraining training;
  training.views = 20;  // with fewer the pose may be half a turn off: the box is nearly symmetric
  training.distance = 0.5;
  training.camera.width = 320;
  training.camera.height = 240;
  training.camera.cx = 159.5;
  training.camera.cy = 119.5;
  return training;
}

inline const SimulatedScene& notchedScene() {
  static const SimulatedScene scene = [] {
    SceneOptions options;
    options.objects = 1;
    options.distractors = 2;
    options.region = 0.15;
    options.wall_share = 0;
    options.max_distance = 0.8;
    return simulateScene({{"thing", "thing.obj", std::make_shared<Mesh>(notchedMesh())}}, options, 0);
  }();
  return scene;
}

/// The object alone as the camera of the scene sees it: organised, with pixels where nothing was measured.
inline Cloud notchedView() {
  Renderer renderer;
  renderer.addInstance(renderer.addMesh(std::make_shared<Mesh>(notchedMesh())), Eigen::Isometry3d::Identity());
  CameraModel camera = closeViews().camera;
  camera.noise = CameraNoise::none();
  const Eigen::Isometry3d& T_camera_model = notchedScene().objects.at(0).T_camera_model;
  const Eigen::Vector3d center = 0.5 * box_size.cast<double>();
  const Eigen::Vector3d eye = center + 0.6 * (T_camera_model.inverse().translation() - center).normalized();
  return renderer.render(camera, lookAt(eye, center, Eigen::Vector3d::UnitZ()), 0, 1).cloud;
}

inline std::vector<Detection> detectionsInScene(const Codebook& codebook, const Cloud& cloud) {
  return Detector(codebook).detect(cloud).above(0.5);
}
inline std::vector<Detection> detectionsInScene(const Codebook& codebook) {
  return detectionsInScene(codebook, notchedScene().view.cloud);
}

/// @param metres, degrees the most that the two may differ
inline void expectNear(const Eigen::Isometry3d& pose, const Eigen::Isometry3d& right, double metres, double degrees) {
  EXPECT_LT((pose.translation() - right.translation()).norm(), metres);
  constexpr double degree = 0.017453292519943295;
  EXPECT_LT(Eigen::AngleAxisd(pose.linear().transpose() * right.linear()).angle() / degree, degrees);
}

/// The same objects at the same places. @param rounded the training data differed in the last digit: other pixels lie
/// just beside an edge then, and other keypoints are kept; the noise of the scene moves the pose as far from the truth
inline void expectSameDetections(const std::vector<Detection>& found, const std::vector<Detection>& right,
                                 bool rounded = false) {
  ASSERT_EQ(found.size(), right.size());
  for (std::size_t i = 0; i < right.size(); ++i) {
    EXPECT_EQ(found[i].object, right[i].object);
    EXPECT_NEAR(found[i].score, right[i].score, rounded ? 0.05 : 1e-9);
    if (rounded) {
      expectNear(found[i].T_scene_model, notchedScene().objects.at(i).T_camera_model, 1e-3, 0.75);
    } else {
      expectNear(found[i].T_scene_model, right[i].T_scene_model, 1e-9, 1e-6);
    }
    EXPECT_TRUE(found[i].box_size.isApprox(right[i].box_size, 1e-5));
  }
}

}  // namespace sks::test
