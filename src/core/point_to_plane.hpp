// SPDX-License-Identifier: BSD-3-Clause
// What the rounds of point-to-plane ICP have in common, however pairs are found.
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/settings.hpp>

namespace sks {

/// A point of the model, mapped into the scene, with its partner there.
struct PointPair {
  Eigen::Vector3d model;
  Eigen::Vector3d scene;
  Eigen::Vector3d normal;  ///< of the scene
};

constexpr std::size_t fewest_pairs = 6;   // as many as a rigid motion has degrees of freedom
constexpr float normal_agreement = 0.7f;  // cosine; about 45 degrees

/// Farthest that the pairs of a round may lie apart [m]: shrinks geometrically from the start to the end distance.
double pairDistance(const RefinementSettings& settings, int round);

/// The small motion that brings the model's points onto the planes of their partners, in least squares with Tukey
/// weights. @param scale [m] pairs whose distance from the plane is larger do not count
Eigen::Isometry3d pointToPlaneStep(const std::vector<PointPair>& pairs, double scale);

}  // namespace sks
