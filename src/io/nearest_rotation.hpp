// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <Eigen/Core>

namespace sks {

/// A matrix that is meant to be a rotation, as files have it, and the rotation that is nearest to it.
struct NearestRotation {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< nearest in the Frobenius norm
  double deviation = 0;                                    ///< largest entry of |R^T R - I| of the matrix
  std::string fault;  ///< why it is no rotation, e.g. "is scaled by 0.001"; empty if it is nearly one
};

/// Deviation from which on a rotation is worth a warning: published poses are orthonormal to 0.01.
constexpr double skew_rotation = 0.01;

/// A matrix is nearly a rotation where its deviation is at most 0.1 and its determinant is positive.
NearestRotation nearestRotation(const Eigen::Matrix3d& matrix);

}  // namespace sks
