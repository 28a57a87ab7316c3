// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <sks_detector/stages/large_planes.hpp>
#include <sks_detector/stages/surface.hpp>

#include "core/verification/pile_parts.hpp"
#include "core/verification/resting_poses.hpp"

namespace sks {

/// Something that stands or lies on a large plane with nothing near it.
struct StandingThing {
  Eigen::Vector3f up = Eigen::Vector3f::UnitZ();       ///< normal of the plane that it stands on, towards the sensor
  float floor = 0;                                     ///< up . p for points p of that plane [m]
  float height = 0;                                    ///< of its top above the plane [m]
  Eigen::Vector3f centroid = Eigen::Vector3f::Zero();  ///< of what is seen of it [m]
  BaseExtent base;                                     ///< of what is seen of it, within the plane
};

struct StandingThings {
  std::vector<StandingThing> things;  ///< largest first
  std::vector<PilePart> parts;        ///< of what stands there, where things touch each other
  /// For each scene point whether it rises above the plane below it, also by less than a plane's tolerance: no part of
  /// that plane.
  std::vector<char> rises;
};

/// What stands on the large planes of a scene: connected groups of points that rise from a plane, down to a few
/// millimetres, which many points that lie side by side tell from the noise. Deterministic, for any number of threads.
/// @param largest what is larger than this stands there as furniture [m]
/// @param stick_width of the thinnest stick among the objects [m]; 0: there is none
StandingThings findStandingThings(const Surface& scene, const std::vector<LargePlane>& planes, float largest,
                                  float stick_width = 0, int threads = 1);

}  // namespace sks
