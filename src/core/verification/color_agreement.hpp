// SPDX-License-Identifier: BSD-3-Clause
// How colours of a stored surface and of a scene are compared. Colours are CIELab, scaled as in Surface.
#pragma once

#include <Eigen/Core>

namespace sks {

/// Squared distance in units of CIELab, in which 2 is just noticeable. Lightness counts half: it changes with light and
/// shade where the object stays the same.
inline float squaredColorDifference(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  const Eigen::Vector3f units(50, 120, 120);  // of the scaled colours; of lightness half
  return (a - b).cwiseProduct(units).squaredNorm();
}

/// 1 for equal colours, falling to 0 with a Gaussian of the difference. @param tolerance its sigma, in units of CIELab
float colorAgreement(float squared_difference, float tolerance);

}  // namespace sks
