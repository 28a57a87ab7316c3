// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace sks {

/// An object that looks the same after a rotation about an axis through the centre of its box.
struct Symmetry {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit vector, model frame
  int order = 0;                                    ///< rotations by 360 / order degrees; 0: any rotation
};

}  // namespace sks
