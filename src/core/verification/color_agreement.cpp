// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/color_agreement.hpp"

#include <cmath>

namespace sks {
float colorAgreement(float squared_difference, float tolerance) {
  return std::exp(-0.5f * squared_difference / (tolerance * tolerance));
}

}  // namespace sks
