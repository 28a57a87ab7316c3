// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/symmetry.hpp>

namespace sks {

/// Every motion after which an object looks the same, in the model frame, as the BOP challenge lists them.
struct ObjectSymmetries {
  /// Of a body of revolution.
  struct Axis {
    Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< unit vector
    Eigen::Vector3d position = Eigen::Vector3d::Zero();    ///< the axis goes through it
  };

  std::vector<Eigen::Isometry3d> discrete;  ///< without the identity
  std::vector<Axis> continuous;
};

}  // namespace sks
