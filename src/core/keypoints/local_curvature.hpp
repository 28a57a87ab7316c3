// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <sks_detector/stages/surface.hpp>

namespace sks {

/// Gaussian curvature K = kappa_1 kappa_2 >= 0 of the surface within `radius` of `center` (section 4): the determinant
/// of the covariance of the neighbours' normals in the tangent plane of `normal`. SIMD, runtime dispatch.
/// @param runs of the neighbours, from PointGrid::findRuns()
float gaussianCurvature(const Surface& surface, const Eigen::Vector3f& center, const Eigen::Vector3f& normal,
                        float radius, const std::vector<PointGrid::Run>& runs);

}  // namespace sks
