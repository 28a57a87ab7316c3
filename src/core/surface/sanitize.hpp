// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include <sks_detector/cloud.hpp>
#include <sks_detector/settings.hpp>
#include <sks_detector/stages/surface.hpp>

namespace sks {

/// What sanitize() took away.
struct SanitizeReport {
  std::size_t input = 0;         ///< points given
  std::size_t invalid = 0;       ///< NaN or infinite
  std::size_t out_of_range = 0;  ///< nearer or farther from the sensor than allowed, or outside the crop box
  std::size_t duplicates = 0;    ///< at exactly the position of an earlier point
  std::size_t kept = 0;
};

/// The settings for a cloud whose normals are to point this way: a full model's origin is no sensor, so that no point
/// is too near to it.
SanitizeSettings sanitizingFor(Orientation orientation, SanitizeSettings settings);

/// The one gate through which every cloud comes: returns the usable points of `cloud`, in their order.
/// @throws Error(bad_data) if nothing usable is left or the lengths look like millimetres; says which, with figures
/// @param threads the result does not depend on them
Cloud sanitize(const Cloud& cloud, const SanitizeSettings& settings, SanitizeReport* report = nullptr, int threads = 1);

}  // namespace sks
