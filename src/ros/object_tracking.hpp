// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include <sks_detector/background_search.hpp>
#include <sks_detector/cloud.hpp>
#include <sks_detector/detector.hpp>
#include <sks_detector/tracker.hpp>

namespace sks_detector {

/// Follows objects from cloud to cloud: a tracker, and the searches of whole clouds that it asks for, one at a time in
/// a thread of low priority. follow() and clear() are for one thread, summary() for any.
class ObjectTracking {
public:
  struct Summary {
    bool active = false;  ///< since the last clear()
    std::size_t tracks = 0;
    sks::TrackingCounts counts;  ///< since the start of the node
  };

  /// The objects in a new cloud. With another detector than before all tracks begin anew.
  /// @throws sks::Error, also where an earlier cloud could not be searched
  std::vector<sks::TrackedObject> follow(const std::shared_ptr<const sks::Detector>& detector,
                                         const std::shared_ptr<const sks::Cloud>& cloud, const sks::CloudView& view);
  /// Ends all tracks; numbers of objects are not used again.
  void clear();

  Summary summary() const;

private:
  void begin(const std::shared_ptr<const sks::Detector>& detector);
  void takeFinishedSearch();
  void note();

  std::shared_ptr<const sks::Detector> detector_;
  std::optional<sks::Tracker> tracker_;
  std::uint32_t next_id_ = 1;
  sks::TrackingCounts earlier_;  // of trackers before this one
  sks::BackgroundSearch search_;

  mutable std::mutex mutex_;  // guards what follows
  Summary summary_;
};

}  // namespace sks_detector
