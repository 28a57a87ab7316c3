// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace sks {

/// Those of the points that are not at exactly the position of an earlier one, in their order; -0 is 0. Takes n log n
/// steps at most, wherever the points lie. @param points finite where `indices` name them [m]
/// @param indices into `points`, ascending @param threads the result does not depend on them
std::vector<std::uint32_t> distinctPoints(const std::vector<Eigen::Vector3f>& points,
                                          const std::vector<std::uint32_t>& indices, int threads);

}  // namespace sks
