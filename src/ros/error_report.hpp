// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <map>
#include <mutex>
#include <string>

#include "ros/status_board.hpp"

namespace sks_detector {

/// Says what goes wrong frame after frame, without flooding the log: a new message of a kind at most once a second, the
/// same one twice a minute. Safe to use from several threads.
class ErrorReport {
public:
  /// @param board must outlive it
  explicit ErrorReport(StatusBoard& board) : board_(board) {}

  /// Logs an error and leaves it in the status.
  void error(const std::string& kind, const std::string& message);
  /// What failed works again: takes its error out of the status.
  void clear(const std::string& kind);
  /// Only logs.
  void warning(const std::string& kind, const std::string& message);

private:
  using Clock = std::chrono::steady_clock;

  struct Said {
    std::string message;
    Clock::time_point when;
  };

  bool isDue(const std::string& kind, const std::string& message);

  StatusBoard& board_;
  std::mutex mutex_;
  std::map<std::string, Said> said_;  // last of each kind
};

}  // namespace sks_detector
