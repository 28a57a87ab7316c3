// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <memory>

#include <Eigen/Geometry>

#include <sks_detector/simulation/mesh.hpp>
#include <sks_detector/simulation/training_views.hpp>

#include "simulation/renderer.hpp"
#include "simulation/shapes.hpp"

namespace sks::test {

/// Adds a table whose top is z = 0, for an object in its middle.
inline void addTable(Renderer& renderer) {
  const auto table = std::make_shared<const Mesh>(makeBox({1, 1, 0.02f}, plain({150, 140, 130}), 0.02f));
  renderer.addInstance(renderer.addMesh(table), Eigen::Isometry3d(Eigen::Translation3d(0, 0, -0.01)));
}

/// T_table_mesh of a mesh that stands in the middle of the table.
inline Eigen::Isometry3d standingPose(const Mesh& mesh) {
  const Eigen::AlignedBox3f box = mesh.box();
  const Eigen::Vector3f base(box.center().x(), box.center().y(), box.min().z());
  return Eigen::Isometry3d(Eigen::Translation3d(-base.cast<double>()));
}

/// A rotation about the vertical.
inline Eigen::Isometry3d turnedBy(double degrees) {
  return Eigen::Isometry3d(Eigen::AngleAxisd(degrees * EIGEN_PI / 180, Eigen::Vector3d::UnitZ()));
}

/// T_table_camera of a camera that looks at a target. @param degrees direction in which the camera is, 0: +x
inline Eigen::Isometry3d cameraAt(const Eigen::Vector3d& target, double degrees, double elevation, double distance) {
  const Eigen::Vector3d direction(std::cos(elevation), 0, std::sin(elevation));
  return lookAt(target + turnedBy(degrees) * (distance * direction), target, Eigen::Vector3d::UnitZ());
}

/// Adds the forearm of somebody who holds the object: beside it and partly before it, for a camera in the direction of
/// the arm's +x. @return number of the instance
inline std::size_t addForearm(Renderer& renderer, const Eigen::Isometry3d& T_table_arm) {
  const Eigen::Vector3f hand(0.05f, 0.04f, 0.05f), elbow(0.16f, 0.28f, 0.2f);
  const auto arm = std::make_shared<const Mesh>(makeRod(hand, elbow, 0.025f, 0.04f, plain({220, 170, 140})));
  return renderer.addInstance(renderer.addMesh(arm), T_table_arm);
}

}  // namespace sks::test
