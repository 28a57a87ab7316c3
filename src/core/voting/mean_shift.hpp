// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <sks_detector/settings.hpp>

namespace sks {

/// A maximum of the density of a point set.
struct Maximum {
  Eigen::Vector3f position;          ///< [m]
  double density = 0;                ///< sum of K((x - p_i) / h), K(u) = exp(-|u|^2 / 2): eq. 3 without its constant
  std::vector<std::uint32_t> votes;  ///< indices of the points within the bandwidth h of the maximum, ascending
};

/// Sum of Gaussian kernels at `x` over all points (eq. 3 times n h^3, so that it counts votes: it does not shrink when
/// the rest of a scene holds more of them). Points farther than 4 h add nothing.
double kernelDensity(const Eigen::Vector3f& x, const std::vector<Eigen::Vector3f>& points, double bandwidth);

/// Mean shift with a Gaussian kernel from every point; maxima nearer than the suppression radius to a denser one are
/// suppressed. Strongest first; independent of the order of the points but for ties. Every point can seed a maximum,
/// so a lone point is one too (subject to min_votes).
std::vector<Maximum> findMaxima(const std::vector<Eigen::Vector3f>& points, const VotingSettings& settings);

}  // namespace sks
