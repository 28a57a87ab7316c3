// SPDX-License-Identifier: BSD-3-Clause
#include "io/nearest_rotation.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>

#include "core/settings/number_format.hpp"

namespace sks {
namespace {

constexpr double largest_deviation = 0.1;

std::string faultOf(const Eigen::Matrix3d& matrix, const Eigen::Vector3d& scales, double deviation) {
  if (matrix.determinant() < 0) return "is a reflection (its determinant is negative)";
  if (deviation <= largest_deviation) return "";
  if (scales(2) > 0 && scales(0) / scales(2) < 1 + largest_deviation) {
    return formatted("is scaled by %.3g", scales.mean());
  }
  return formatted("is no rotation: its columns are not orthonormal, R^T R differs from the identity by %.3g",
                   deviation);
}

}  // namespace

NearestRotation nearestRotation(const Eigen::Matrix3d& matrix) {
  NearestRotation result;
  if (!matrix.allFinite()) {
    result.fault = "holds numbers that are not finite";
    return result;
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  result.deviation = (matrix.transpose() * matrix - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  result.fault = faultOf(matrix, svd.singularValues(), result.deviation);
  result.rotation = svd.matrixU() * svd.matrixV().transpose();
  return result;
}

}  // namespace sks
