// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <sks_detector/codebook.hpp>
#include <sks_detector/settings.hpp>
#include <sks_detector/stages/hypothesis.hpp>
#include <sks_detector/stages/surface.hpp>
#include <sks_detector/stages/voting.hpp>

namespace sks {

/// The maxima of one object's Hough space.
struct ObjectMaximum {
  std::uint32_t object = 0;
  Maximum maximum;
};

/// Those of every object, strongest first within each object, at most `detection.max_per_object` of each.
std::vector<ObjectMaximum> findAllMaxima(const std::vector<std::vector<Vote>>& spaces, const Settings& settings,
                                         int threads);

/// The maxima that pass RANSAC (section 3.2), refined where `refinement.iterations` says so.
std::vector<Hypothesis> houghHypotheses(const Codebook& codebook, const std::vector<std::vector<Vote>>& spaces,
                                        const std::vector<ObjectMaximum>& maxima, const Surface& scene,
                                        const Settings& settings, int threads);

}  // namespace sks
