// SPDX-License-Identifier: BSD-3-Clause
#include "ros/object_tracking.hpp"

#include <utility>

#include <sks_detector/error.hpp>

namespace sks_detector {
namespace {

void add(const sks::TrackingCounts& more, sks::TrackingCounts& counts) {
  counts.begun += more.begun;
  counts.lost += more.lost;
  counts.found_again += more.found_again;
  counts.identity_changes += more.identity_changes;
}

}  // namespace

std::vector<sks::TrackedObject> ObjectTracking::follow(const std::shared_ptr<const sks::Detector>& detector,
                                                       const std::shared_ptr<const sks::Cloud>& cloud,
                                                       const sks::CloudView& view) {
  if (!tracker_ || detector != detector_) begin(detector);
  takeFinishedSearch();
  std::vector<sks::TrackedObject> objects = tracker_->follow(*cloud, view);
  if (!search_.started() && tracker_->wantsDetection(view.stamp)) {
    search_.start(detector_, cloud, view, tracker_->occupied());
  }
  note();
  return objects;
}

void ObjectTracking::clear() {
  if (!tracker_) return;
  search_.drop();
  next_id_ = tracker_->nextId();
  add(tracker_->counts(), earlier_);
  tracker_.reset();
  detector_.reset();
  note();
}

ObjectTracking::Summary ObjectTracking::summary() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return summary_;
}

void ObjectTracking::begin(const std::shared_ptr<const sks::Detector>& detector) {
  sks::Tracker tracker(*detector, tracker_ ? tracker_->nextId() : next_id_);
  clear();
  tracker_ = std::move(tracker);
  detector_ = detector;
}

void ObjectTracking::takeFinishedSearch() {
  if (!search_.finished()) return;
  try {
    search_.giveTo(*tracker_);
  } catch (const sks::Error&) {
    if (tracker_->size() == 0) throw;  // else what is followed goes on, and the next search tells
  }
}

void ObjectTracking::note() {
  const std::lock_guard<std::mutex> lock(mutex_);
  summary_ = {tracker_.has_value(), tracker_ ? tracker_->size() : 0, earlier_};
  if (tracker_) add(tracker_->counts(), summary_.counts);
}

}  // namespace sks_detector
