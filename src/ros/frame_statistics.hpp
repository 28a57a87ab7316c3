// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>

namespace sks_detector {

/// What became of the latest clouds. Safe to use from several threads.
class FrameStatistics {
public:
  struct Summary {
    std::size_t frames = 0;                                    ///< that the times are taken over
    double latency_p50 = 0, latency_p95 = 0, latency_max = 0;  ///< from the message to its answer [s]
    double age = 0;  ///< of the last cloud when it was answered, by its stamp [s]
    std::uint64_t processed = 0, unusable = 0, too_old = 0;  ///< since the start
  };

  /// A cloud was answered.
  void processed(double latency, double age);
  /// A cloud was answered, but only with an empty array: it was unusable.
  void unusable();
  /// A cloud was dropped by ~max_input_age.
  void tooOld(double age);
  /// Forgets times, but not counts.
  void reset();

  Summary summary() const;

private:
  mutable std::mutex mutex_;
  std::deque<double> latencies_;
  Summary summary_;  // but for the latencies
};

}  // namespace sks_detector
