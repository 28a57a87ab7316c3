// SPDX-License-Identifier: BSD-3-Clause
#include "ros/background_job.hpp"

#include <algorithm>
#include <future>
#include <memory>
#include <system_error>

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <sks_detector/error.hpp>

#include "core/settings/threads.hpp"

namespace sks_detector {
namespace {

constexpr int lowest_priority = 19;

/// On Linux each thread has a nice value of its own, which threads that it starts inherit.
void lowerPriority() {
  ::setpriority(PRIO_PROCESS, id_t(::syscall(SYS_gettid)), lowest_priority);
}

/// What a thread of its own does. @throws sks::Error where that cannot be started
template <typename Task>
std::future<void> startedThread(Task task) {
  try {
    return std::async(std::launch::async, task);
  } catch (const std::system_error& error) {
    throw sks::threadError("a thread for the training", error.code().message());
  }
}

}  // namespace

void BackgroundJob::run(const Work& work, const std::function<void(const sks::ProgressState&)>& listener) {
  begin();
  const std::shared_ptr<void> at_end(nullptr, [this](void*) { end(); });
  const sks::Progress progress = [&](const sks::ProgressState& state) {
    listener(state);
    return goesOn();
  };
  startedThread([&] {
    lowerPriority();
    work(progress);
  }).get();
}

void BackgroundJob::begin() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (stopped_) throw sks::Error(sks::ErrorCode::bad_usage, "the node shuts down");
  if (running_) throw sks::Error(sks::ErrorCode::bad_usage, training_runs);
  running_ = true;
  cancelled_ = false;
}

void BackgroundJob::end() {
  const std::lock_guard<std::mutex> lock(mutex_);
  running_ = false;
}

bool BackgroundJob::goesOn() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return !cancelled_ && !stopped_;
}

bool BackgroundJob::cancel() {
  const std::lock_guard<std::mutex> lock(mutex_);
  cancelled_ = true;
  return running_;
}

void BackgroundJob::stop() {
  const std::lock_guard<std::mutex> lock(mutex_);
  stopped_ = true;
}

bool BackgroundJob::running() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return running_;
}

int BackgroundJob::threads() {
  return std::max(1, sks::threadCount(sks::Settings()) - 1);
}

}  // namespace sks_detector
