// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include <sks_detector/error.hpp>

namespace sks {

/// Where long work stands.
struct ProgressState {
  std::string stage;      ///< what is being done, e.g. "training"
  std::string item;       ///< what it is being done to, e.g. the name of a cloud
  std::size_t done = 0;   ///< items finished
  std::size_t total = 0;  ///< items in all, 0 if unknown
};

/// Called between items from the thread that does the work; returns false to cancel. May be empty.
using Progress = std::function<bool(const ProgressState&)>;

/// Reports progress and throws Error(cancelled) if the callback asks to stop.
inline void report(const Progress& progress, const ProgressState& state) {
  if (progress && !progress(state)) {
    throw Error(ErrorCode::cancelled, state.stage + " was cancelled after " + std::to_string(state.done) + " of " +
                                          std::to_string(state.total));
  }
}

}  // namespace sks
