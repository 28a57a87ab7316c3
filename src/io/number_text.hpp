// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sstream>
#include <string>

namespace sks {

/// The number that a whole word of a text file stands for, nan and inf among them, whatever the locale; false if it is
/// no number.
bool parseNumber(const std::string& word, double& value);

/// A text to read numbers, words and lines from, whatever the locale, the ends of its lines (LF, CR or both) and a byte
/// order mark before it.
std::istringstream plainStream(std::string text);

}  // namespace sks
