// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "core/sharing/work_share.hpp"

namespace sks::tools {

/// A thread that works while the calling one deals with other processes.
class LocalWorker {
public:
  using Result = std::pair<std::size_t, std::string>;

  explicit LocalWorker(WorkShare::Work work) : work_(std::move(work)), thread_([this] { run(); }) {}
  /// Waits for the item that it is at.
  ~LocalWorker() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      ends_ = true;
    }
    changed_.notify_one();
    thread_.join();
  }
  LocalWorker(const LocalWorker&) = delete;
  LocalWorker& operator=(const LocalWorker&) = delete;

  /// Whether it waits for an item, and all of its results were collected.
  bool isFree() const { return !busy_; }

  /// To be called where it is free.
  void give(std::size_t item) {
    busy_ = true;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      item_ = item;
    }
    changed_.notify_one();
  }

  /// The result of the item, if it is there by now. @throws what the work threw
  std::optional<Result> collect() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
    if (result_) busy_ = false;
    return std::exchange(result_, std::nullopt);
  }

private:
  void run() {
    for (;;) {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait(lock, [this] { return ends_ || item_; });
      if (ends_) return;
      const std::size_t item = *std::exchange(item_, std::nullopt);
      lock.unlock();
      try {
        std::string bytes = work_(item);
        lock.lock();
        result_ = Result{item, std::move(bytes)};
      } catch (...) {
        if (!lock.owns_lock()) lock.lock();
        failure_ = std::current_exception();
      }
    }
  }

  WorkShare::Work work_;
  bool busy_ = false;  // of the calling thread
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<std::size_t> item_;
  std::optional<Result> result_;
  std::exception_ptr failure_;
  bool ends_ = false;
  std::thread thread_;  // the last, as it uses all others
};

}  // namespace sks::tools
