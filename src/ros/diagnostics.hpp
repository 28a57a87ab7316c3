// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <utility>

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include "ros/cloud_input.hpp"
#include "ros/frame_statistics.hpp"
#include "ros/object_tracking.hpp"
#include "ros/status_board.hpp"

namespace sks_detector {

/// What diagnostics are about; all must outlive them.
struct DiagnosedParts {
  const StatusBoard& board;
  const CloudInput& input;
  const FrameStatistics& statistics;
  const ObjectTracking& tracking;
};

/// What the node says on /diagnostics. For one thread.
class Diagnostics {
public:
  /// @param silence_limit ~silence_warning at the moment [s]
  Diagnostics(const ros::NodeHandle& private_handle, const DiagnosedParts& parts,
              std::function<double()> silence_limit);

  /// Publishes; to be called about once a second.
  void update();
  /// Forgets rates.
  void reset();

private:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;
  using Clock = std::chrono::steady_clock;

  void reportState(Status& status);
  void reportInput(Status& status);
  void reportDetection(Status& status);
  void reportTracking(Status& status);
  void reportCodebook(Status& status);
  void reportProcess(Status& status);
  double inputRate();

  DiagnosedParts parts_;
  std::function<double()> silence_limit_;
  diagnostic_updater::Updater updater_;
  std::deque<std::pair<Clock::time_point, std::uint64_t>> received_;  // when, and how many until then
  std::uint64_t unusable_ = 0, too_old_ = 0;                          // at the last update
};

}  // namespace sks_detector
