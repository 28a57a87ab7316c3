// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace sks {

/// What std::printf() would print, with a decimal point and without grouping whatever the locale of the process.
std::string formatted(const char* format, ...) __attribute__((format(printf, 1, 2)));

}  // namespace sks
