// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sstream>
#include <string>

namespace sks {

/// The number that a whole word of a text file stands for, nan and inf among them, whatever the locale; false if it is
/// no number.
bool parseNumber(const std::string& word, double& value);

/// A text to read numbers and words from, whatever the locale.
std::istringstream plainStream(const std::string& text);

}  // namespace sks
