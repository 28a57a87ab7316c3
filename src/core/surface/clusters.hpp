// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace sks {

using Indices = std::vector<std::uint32_t>;

/// The points that the indices name.
std::vector<Eigen::Vector3f> at(const std::vector<Eigen::Vector3f>& points, const Indices& indices);

/// Groups of points that are connected by steps of at most `gap`, largest first.
std::vector<Indices> findClusters(const std::vector<Eigen::Vector3f>& points, double gap);

}  // namespace sks
