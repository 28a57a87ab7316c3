// SPDX-License-Identifier: BSD-3-Clause
#include "ros/object_tracking.hpp"

#include <chrono>
#include <utility>

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <sks_detector/error.hpp>

namespace sks_detector {
namespace {

constexpr int search_niceness = 10;  // of 19: what is followed at the camera's rate goes first

/// For the calling thread, and those that it starts. If it cannot be done, searches take more from what is followed.
void lowerPriority() {
  setpriority(PRIO_PROCESS, id_t(syscall(SYS_gettid)), search_niceness);
}

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
  if (!search_.valid() && tracker_->wantsDetection(view.stamp)) startSearch(cloud, view);
  note();
  return objects;
}

void ObjectTracking::clear() {
  if (!tracker_) return;
  if (search_.valid()) search_.wait();
  search_ = {};
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
  if (!search_.valid() || search_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  try {
    tracker_->take(std::exchange(search_, {}).get(), searched_);
  } catch (const sks::Error&) {
    if (tracker_->size() == 0) throw;  // else what is followed goes on, and the next search tells
  }
}

void ObjectTracking::startSearch(const std::shared_ptr<const sks::Cloud>& cloud, const sks::CloudView& view) {
  searched_ = view;
  search_ = std::async(std::launch::async, [detector = detector_, cloud, occupied = tracker_->occupied()] {
    lowerPriority();
    return detector->detect(*cloud, nullptr, occupied);
  });
}

void ObjectTracking::note() {
  const std::lock_guard<std::mutex> lock(mutex_);
  summary_ = {tracker_.has_value(), tracker_ ? tracker_->size() : 0, earlier_};
  if (tracker_) add(tracker_->counts(), summary_.counts);
}

}  // namespace sks_detector
