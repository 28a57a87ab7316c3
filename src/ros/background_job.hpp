// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <mutex>

#include <sks_detector/progress.hpp>

namespace sks_detector {

/// What is said to who wants a training while another one runs.
constexpr const char* training_runs = "a training runs already: wait for it, or end it by ~cancel_training";

/// Runs long work in threads of low priority, one at a time, so that it takes what others leave. Safe to use from
/// several threads.
class BackgroundJob {
public:
  using Work = std::function<void(const sks::Progress& progress)>;

  /// Does the work in a thread of its own, which is given the lowest priority, as are those that it starts (OpenMP);
  /// waits for it and passes on what it throws.
  /// @param listener is told of the progress
  /// @throws sks::Error(bad_usage) while other work is done, and after stop()
  void run(const Work& work, const std::function<void(const sks::ProgressState&)>& listener);

  /// Lets the work throw sks::Error(cancelled) at the next progress; false if there is none.
  bool cancel();
  /// Cancels, and refuses any work to come.
  void stop();

  bool running() const;
  /// Threads that work should use: all cores but one.
  static int threads();

private:
  void begin();
  void end();
  bool goesOn() const;

  mutable std::mutex mutex_;
  bool running_ = false, cancelled_ = false, stopped_ = false;
};

}  // namespace sks_detector
