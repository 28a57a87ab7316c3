// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sks_detector/detection.hpp>

#include "core/pipeline/stopwatch.hpp"

namespace sks {

/// Books the time of each stage.
class StageClock {
public:
  /// The result of a stage that has just ended: `x = clock.book(&StageTimes::matching, match(...))`.
  template <typename Result>
  Result book(double StageTimes::*stage, Result result) {
    times_.*stage += stage_.lap();
    return result;
  }

  /// The times so far, with their total.
  StageTimes times() {
    times_.total += total_.lap();
    return times_;
  }

private:
  StageTimes times_;
  Stopwatch stage_, total_;
};

}  // namespace sks
