// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/background_search.hpp>

#include <chrono>
#include <system_error>
#include <utility>

#ifdef __linux__
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

#include "core/settings/threads.hpp"

namespace sks {
namespace {

/// For the calling thread, and those that it starts. If it cannot be done, searches take more from what is followed.
void lowerPriority() {
#ifdef __linux__
  constexpr int niceness = 10;  // of 19
  setpriority(PRIO_PROCESS, id_t(syscall(SYS_gettid)), niceness);
#endif
}

}  // namespace

BackgroundSearch::~BackgroundSearch() {
  drop();
}

void BackgroundSearch::start(std::shared_ptr<const Detector> detector, std::shared_ptr<const Cloud> cloud,
                             const CloudView& view, std::vector<OccupiedBox> occupied) {
  drop();
  view_ = view;
  try {
    result_ = std::async(std::launch::async,
                         [detector = std::move(detector), cloud = std::move(cloud), occupied = std::move(occupied)] {
                           lowerPriority();
                           return detector->detect(*cloud, nullptr, occupied);
                         });
  } catch (const std::system_error& error) {
    throw threadError("a thread for the search", error.code().message());
  }
}

bool BackgroundSearch::started() const {
  return result_.valid();
}

bool BackgroundSearch::finished() const {
  return started() && result_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

void BackgroundSearch::giveTo(Tracker& tracker) {
  if (started()) tracker.take(std::exchange(result_, {}).get(), view_);
}

void BackgroundSearch::drop() {
  if (started()) result_.wait();
  result_ = {};
}

}  // namespace sks
