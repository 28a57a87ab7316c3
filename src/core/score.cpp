// SPDX-License-Identifier: BSD-3-Clause
#include "core/score.hpp"

namespace sks {

double score(const Hypothesis& hypothesis, const DetectionSettings& settings) {
  return hypothesis.density / (hypothesis.density + settings.half_density);
}

}  // namespace sks
