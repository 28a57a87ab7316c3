// SPDX-License-Identifier: BSD-3-Clause
#include "core/local_reference_frame.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace sks {
namespace {

/// `axis` turned to the side on which most neighbours lie; at a tie to the side of their sum.
Eigen::Vector3f disambiguate(const Neighborhood& n, const Eigen::Vector3f& axis) {
  int balance = 0;
  float sum = 0;
  for (std::size_t i = 0; i < n.size; ++i) {
    const float along = n.x[i] * axis.x() + n.y[i] * axis.y() + n.z[i] * axis.z();
    balance += along >= 0 ? 1 : -1;
    sum += along;
  }
  return balance < 0 || (balance == 0 && sum < 0) ? Eigen::Vector3f(-axis) : axis;
}

}  // namespace

bool localReferenceFrame(const Neighborhood& n, float radius, Eigen::Matrix3f& frame) {
  double weights = 0, xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  for (std::size_t i = 0; i < n.size; ++i) {
    const float x = n.x[i], y = n.y[i], z = n.z[i], w = radius - n.distance[i];
    weights += w;
    xx += w * x * x;
    xy += w * x * y;
    xz += w * x * z;
    yy += w * y * y;
    yz += w * y * z;
    zz += w * z * z;
  }
  if (!(weights > 0)) return false;
  Eigen::Matrix3d covariance;
  covariance << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance / weights);
  if (!(solver.eigenvalues()[2] > 0)) return false;
  const Eigen::Vector3f x = disambiguate(n, solver.eigenvectors().col(2).cast<float>());
  const Eigen::Vector3f z = disambiguate(n, solver.eigenvectors().col(0).cast<float>());
  frame.row(0) = x;
  frame.row(1) = z.cross(x);
  frame.row(2) = z;
  return frame.allFinite();
}

}  // namespace sks
