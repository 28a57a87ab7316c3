// SPDX-License-Identifier: BSD-3-Clause
#include "core/settings/threads.hpp"

#include <cstdio>
#include <fstream>
#include <thread>

#include <sys/resource.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/detector.hpp>
#include <sks_detector/trainer.hpp>

#include "bumps.hpp"
#include "error_of.hpp"
#include "synthetic.hpp"

#ifdef SKS_EXECUTABLE
#include "run_sks.hpp"
#endif

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool under_sanitizer = true;  // which takes all of the address space
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool under_sanitizer = true;
#else
constexpr bool under_sanitizer = false;
#endif
#else
constexpr bool under_sanitizer = false;
#endif

namespace sks {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

Settings withThreadCount(int threads) {
  Settings settings;
  settings.threads = threads;
  return settings;
}

/// Lets this process have so much more memory.
void limitMemory(std::size_t more) {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlim_t bytes = pages * std::size_t(::sysconf(_SC_PAGESIZE)) + more;
  const rlimit limit{bytes, bytes};
  ::setrlimit(RLIMIT_AS, &limit);
}

/// Trains and detects with 16 threads, whose stacks are 2 or 8 MB each, in 24 MB; ends with 0 if that is an error.
[[noreturn]] void detectWithLittleMemory() {
  try {
    const Cloud cloud = test::bumps();
    const Codebook codebook =
        train({{"bumps", "bumps.pcd", ViewKind::view, [&] { return cloud; }, {}, {}}}, withThreadCount(1), "toys");
    const Detector detector(codebook, withThreadCount(16));
    limitMemory(24u << 20);
    std::string message;
    for (int i = 0; i < 2; ++i) {
      message = test::errorOf(ErrorCode::bad_usage, [&] { detector.detect(cloud); });
      if (message.find("cannot start 16 threads") == std::string::npos) std::_Exit(1);
    }
    std::fputs((message + "\n").c_str(), stderr);
    if (detector.withSettings(withThreadCount(1)).detect(cloud).detections.empty()) std::_Exit(2);
    std::_Exit(0);
  } catch (const std::exception& error) {
    std::fputs(error.what(), stderr);
  }
  std::_Exit(3);
}

}  // namespace

TEST(Threads, AreCappedByTheCoresButSixteenAreAlwaysAllowed) {
  const int cores = std::max(1, int(std::thread::hardware_concurrency()));
  EXPECT_EQ(threadCount(withThreadCount(0)), cores);
  for (int threads = 1; threads <= 16; ++threads) {
    EXPECT_EQ(threadCount(withThreadCount(threads)), threads);
    EXPECT_THAT(tooManyThreads(withThreadCount(threads)), IsEmpty());
  }
  EXPECT_EQ(mostThreads(), std::max(16, cores));
  EXPECT_EQ(threadCount(withThreadCount(256)), std::min(256, mostThreads()));
  if (mostThreads() >= 256) return;
  EXPECT_THAT(tooManyThreads(withThreadCount(256)),
              AllOf(HasSubstr("threads = 256"), HasSubstr(std::to_string(mostThreads()) + " are used")));
}

TEST(Threads, ThatCanBeStartedAreTheirNumber) {
  for (const int threads : {1, 16, 3, 8, 0}) {
    EXPECT_EQ(startableThreads(withThreadCount(threads)), threadCount(withThreadCount(threads)));
  }
}

TEST(ThreadsDeathTest, ThatCannotBeStartedAreAnErrorAndNotTheEnd) {
  if (under_sanitizer) GTEST_SKIP() << "sanitizers take all of the address space";
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(detectWithLittleMemory(), testing::ExitedWithCode(0), "cannot start 16 threads.*lower the setting");
}

#ifdef SKS_EXECUTABLE

TEST(Threads, CommandLineSaysThatItUsesFewer) {
  if (mostThreads() >= 256) GTEST_SKIP() << "this machine has as many";
  const auto run = test::runSks({"settings", "--set", "threads=256"});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.errors, HasSubstr("warning: threads = 256: " + std::to_string(mostThreads()) + " are used"));
  EXPECT_THAT(test::runSks({"settings", "--set", "threads=16"}).errors, IsEmpty());
}

#endif  // SKS_EXECUTABLE

}  // namespace sks
