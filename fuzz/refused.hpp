// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <iostream>

#include <sks_detector/error.hpp>

namespace sks::fuzz {

/// Whether an action refuses its input. It may do so by an sks::Error that says why; any other exception is a finding
/// and ends the program.
template <typename Action>
bool refused(Action&& action) {
  try {
    action();
    return false;
  } catch (const Error& error) {
    if (error.what()[0] == '\0') std::abort();
    return true;
  }
}

/// Ends the program where something does not hold that must.
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::cerr << "does not hold: " << what << std::endl;
  std::abort();
}

}  // namespace sks::fuzz
