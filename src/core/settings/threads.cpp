// SPDX-License-Identifier: BSD-3-Clause
#include "core/settings/threads.hpp"

#include <algorithm>
#include <atomic>
#include <future>
#include <system_error>
#include <thread>
#include <vector>

#include "core/settings/core_share.hpp"

namespace sks {
namespace {

constexpr int always_allowed = 16;  // whatever the machine has: so many can be tried anywhere

std::atomic<int> processes_here{1};  // that share the cores

int cores() {
  return std::max(1, int(std::thread::hardware_concurrency()) / processes_here);
}

/// Starts threads that are there at one time, and ends them; why that fails, or nothing.
std::string failureToStart(int count) {
  std::promise<void> release;
  const std::shared_future<void> released = release.get_future().share();
  std::vector<std::thread> threads;
  std::string failure;
  try {
    for (int i = 0; i < count; ++i) threads.emplace_back([released] { released.wait(); });
  } catch (const std::system_error& error) {
    failure = error.code().message();
  } catch (const std::bad_alloc&) {
    failure = std::make_error_code(std::errc::not_enough_memory).message();
  }
  release.set_value();
  for (std::thread& thread : threads) thread.join();
  return failure;
}

}  // namespace

void shareCores(int processes) {
  processes_here = std::max(1, processes);
}

int mostThreads() {
  return std::max(always_allowed, cores());
}

int threadCount(const Settings& settings) {
  return settings.threads > 0 ? std::min(settings.threads, mostThreads()) : cores();
}

std::string tooManyThreads(const Settings& settings) {
  if (settings.threads <= mostThreads()) return "";
  return "threads = " + std::to_string(settings.threads) + ": " + std::to_string(mostThreads()) +
         " are used, as more are of no use on this machine (" + std::to_string(cores()) +
         (cores() == 1 ? " core)" : " cores)");
}

int startableThreads(const Settings& settings) {
  thread_local int started = 1;  // by OpenMP for this thread, which ends those beyond the last count
  const int count = threadCount(settings);
  if (count > started) {
    const std::string failure = failureToStart(count - 1);
    if (!failure.empty()) throw threadError(std::to_string(count) + " threads", failure);
  }
  started = count;
  return count;
}

Error threadError(const std::string& what, const std::string& reason) {
  return {ErrorCode::bad_usage, "cannot start " + what + ": " + reason +
                                    "; lower the setting 'threads', or raise the limits of this process on memory "
                                    "(ulimit -v) and on threads (ulimit -u)"};
}

}  // namespace sks
