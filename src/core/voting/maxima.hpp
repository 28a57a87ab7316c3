// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <sks_detector/settings.hpp>
#include <sks_detector/stages/voting.hpp>

#include "core/voting/mean_shift.hpp"

namespace sks {

/// The maxima of one object's Hough space.
struct ObjectMaximum {
  std::uint32_t object = 0;
  Maximum maximum;
};

/// Those of every object, strongest first within each object, at most `detection.max_per_object` of each.
std::vector<ObjectMaximum> findAllMaxima(const std::vector<std::vector<Vote>>& spaces, const Settings& settings,
                                         int threads);

}  // namespace sks
