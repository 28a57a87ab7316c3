// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <future>
#include <memory>
#include <vector>

#include <sks_detector/cloud.hpp>
#include <sks_detector/detector.hpp>
#include <sks_detector/tracker.hpp>

namespace sks {

/// Searches whole clouds for a Tracker, one at a time, in a thread of low priority: where there are fewer cores than
/// threads, what is followed at the camera's rate goes first.
///
///     if (search.finished()) search.giveTo(tracker);
///     tracked = tracker.follow(*cloud, view);
///     if (!search.started() && tracker.wantsDetection(view.stamp))
///       search.start(detector, cloud, view, tracker.occupied());
///
/// Not thread-safe: for the one thread that has the tracker. The priority is lowered on Linux only.
class BackgroundSearch {
public:
  BackgroundSearch() = default;
  /// Waits for a search that runs: at most as long as one takes.
  ~BackgroundSearch();
  BackgroundSearch(const BackgroundSearch&) = delete;
  BackgroundSearch& operator=(const BackgroundSearch&) = delete;

  /// Searches a cloud as Detector::detect() does. One that runs is waited for, and its result is dropped.
  /// @param occupied Tracker::occupied() after the cloud was followed
  /// @throws Error(bad_usage) where the thread cannot be started
  void start(std::shared_ptr<const Detector> detector, std::shared_ptr<const Cloud> cloud, const CloudView& view,
             std::vector<OccupiedBox> occupied);
  bool started() const;   ///< and its result neither given nor dropped
  bool finished() const;  ///< of one that was started; false if there is none

  /// Tracker::take() with the result; waits for it if the search still runs. Does nothing if none was started.
  /// @throws Error of Detector::detect(); the search counts as given then
  void giveTo(Tracker& tracker);
  /// Waits for one that runs, and drops its result.
  void drop();

private:
  std::future<DetectionResult> result_;
  CloudView view_;
};

}  // namespace sks
