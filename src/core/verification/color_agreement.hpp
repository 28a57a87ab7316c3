// SPDX-License-Identifier: BSD-3-Clause
// How colours of a stored surface and of a scene are compared. Colours are CIELab, scaled as in Surface.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <sks_detector/codebook.hpp>

namespace sks {

/// Squared distance in units of CIELab, in which 2 is just noticeable. Lightness counts half: it changes with light and
/// shade where the object stays the same.
float squaredColorDifference(const Eigen::Vector3f& a, const Eigen::Vector3f& b);

/// 1 for equal colours, falling to 0 with a Gaussian of the difference. @param tolerance its sigma, in units of CIELab
float colorAgreement(float squared_difference, float tolerance);

/// How much the colours around each point of a view's stored surface vary, in [0, 1): prints say as much as edges.
/// Zeros for a view without colour.
std::vector<float> colorVariation(const TrainingView& view, float radius);

}  // namespace sks
