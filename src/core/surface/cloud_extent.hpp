// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sks_detector/cloud.hpp>
#include <sks_detector/settings.hpp>
#include <sks_detector/stages/surface.hpp>

namespace sks {

/// Refuses a cloud that is far too small for its settings, as one is that was scaled to metres twice: all of it lies
/// within one neighbourhood, which says nothing and takes the square of its points in time.
/// @param cloud of finite points @throws Error(bad_data) with its size, the setting and the remedy
void checkExtent(const Cloud& cloud, Orientation orientation, const Settings& settings);

}  // namespace sks
