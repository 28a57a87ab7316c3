// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>

#include <sks_detector/progress.hpp>

namespace sks::tools {

/// From now on SIGINT and SIGTERM make every ProgressBar cancel its work, so that nothing is left half done; the second
/// one ends the process at once.
void cancelOnInterrupt();

/// Shows progress with rate and time left on one line of stderr, only where that is a terminal.
class ProgressBar {
public:
  ProgressBar();
  ~ProgressBar();  ///< wipes the line
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Refers to this bar, which must outlive it.
  Progress callback();

  void clear();

private:
  using Clock = std::chrono::steady_clock;

  void show(const ProgressState& state);

  bool terminal_;
  bool shown_ = false;
  std::string stage_;
  Clock::time_point start_;
  Clock::time_point last_;
};

/// The line without its end, e.g. "training  12/95 [###-----] 3.1/s, 27 s left  mario000.pcd", at most `width` wide.
std::string progressLine(const ProgressState& state, double seconds, std::size_t width);

}  // namespace sks::tools
