// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

namespace sks {

/// Wall-clock time since it was made or last asked.
class Stopwatch {
public:
  /// Seconds since the last lap.
  double lap() {
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

}  // namespace sks
