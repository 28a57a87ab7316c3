// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <deque>
#include <string>

namespace sks_detector {

/// Rate and latencies of the results of the last seconds.
class StreamWatch {
public:
  using Clock = std::chrono::steady_clock;

  /// @param latency from the stamp of the cloud to the arrival of its result [s]
  /// @param processing the part of it that the node took [s]
  void add(Clock::time_point now, double latency, double processing);
  void clear() { results_.clear(); }

  /// "4.8 clouds/s, 0.21 s from camera to result, 0.19 s of them in the node" (medians).
  std::string describe(Clock::time_point now);

private:
  struct Result {
    Clock::time_point time;
    double latency;
    double processing;
  };
  std::deque<Result> results_;
};

}  // namespace sks_detector
