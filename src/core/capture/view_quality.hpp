// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <sks_detector/cloud.hpp>
#include <sks_detector/settings.hpp>

namespace sks {

/// What a view of an object is worth as a training view.
struct ViewQuality {
  std::size_t points = 0;                            ///< on the object
  Eigen::Vector3f extent = Eigen::Vector3f::Zero();  ///< of the object along the axes of the cloud's frame [m]
  double spacing = 0;                                ///< median distance of neighbouring points [m]
  std::vector<std::string> remarks;                  ///< what is not good, and what to do; none if all is well
};

/// Looks at the object that `points` of a cloud show: whether it is whole, near enough for the settings, coloured.
/// @param points ascending indices of finite points, at least one
ViewQuality assessView(const Cloud& cloud, const std::vector<std::uint32_t>& points, const Settings& settings);

}  // namespace sks
