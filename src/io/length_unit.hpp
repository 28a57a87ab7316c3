// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

namespace sks {

/// Metres in a unit: m, cm, mm, inch or in, or a number of metres from 1e-9 to 1000; nothing for another text.
std::optional<double> metresIn(const std::string& unit);

/// For messages: the units that are known.
constexpr const char* known_units = "m, cm, mm, inch or a number of metres";

}  // namespace sks
