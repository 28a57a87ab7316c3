// SPDX-License-Identifier: BSD-3-Clause
// A square plate and a small camera whose pixels can be counted by hand.
#pragma once

#include <Eigen/Geometry>

#include "evaluation/object_model.hpp"
#include "evaluation/scene_depth.hpp"

namespace sks::test {

/// 0.2 m wide. At 1 m, by plateCamera(), it covers the columns 41 to 60 and the rows 31 to 50: 20 x 20 pixels.
inline ObjectModel plate() {
  ObjectModel model;
  for (const double y : {-0.095, 0.105}) {
    for (const double x : {-0.095, 0.105}) model.points.emplace_back(x, y, 0);
  }
  model.triangles = {{0, 1, 2}, {1, 3, 2}};
  model.diameter = diameterOf(model.points);
  return model;
}

/// A pixel sees 1 cm at 1 m.
inline SceneCamera plateCamera() {
  return {100, 80, 100, 100, 50, 40};
}

inline Eigen::Isometry3d at(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

}  // namespace sks::test
