// SPDX-License-Identifier: BSD-3-Clause
#include "io/length_unit.hpp"

#include "core/settings/value_text.hpp"

namespace sks {

std::optional<double> metresIn(const std::string& unit) {
  if (unit == "m") return 1.0;
  if (unit == "cm") return 0.01;
  if (unit == "mm") return 0.001;
  if (unit == "inch" || unit == "in") return 0.0254;
  double metres = 0;
  if (fromText(unit, metres) && metres >= 1e-9 && metres <= 1000) return metres;
  return std::nullopt;
}

}  // namespace sks
