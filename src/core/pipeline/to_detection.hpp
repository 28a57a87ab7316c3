// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sks_detector/codebook.hpp>
#include <sks_detector/detection.hpp>
#include <sks_detector/stages/hypothesis.hpp>

namespace sks {

/// A hypothesis by the names of the codebook. @throws Error(bad_data) if it refers to what the codebook does not hold
Detection toDetection(const Codebook& codebook, const Hypothesis& hypothesis, double score);

}  // namespace sks
