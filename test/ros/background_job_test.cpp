// SPDX-License-Identifier: BSD-3-Clause
#include "ros/background_job.hpp"

#include <future>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "error_of.hpp"

namespace sks_detector {
namespace {

using sks::ErrorCode;
using sks::test::errorOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

int priorityOfThisThread() {
  return ::getpriority(PRIO_PROCESS, id_t(::syscall(SYS_gettid)));
}

void ignore(const sks::ProgressState&) {}

/// A job that has begun and goes on until it is cancelled.
class Endless {
public:
  explicit Endless(BackgroundJob& job)
      : message_(std::async(std::launch::async, [&job, this] {
          return errorOf(ErrorCode::cancelled, [&] {
            job.run(
                [this](const sks::Progress& progress) {
                  begun_.set_value();
                  for (std::size_t i = 0;; ++i) sks::report(progress, {"work", "", i, 0});
                },
                ignore);
          });
        })) {
    begun_.get_future().wait();
  }

  std::string message() { return message_.get(); }

private:
  std::promise<void> begun_;
  std::future<std::string> message_;
};

TEST(BackgroundJob, WorksAtTheLowestPriorityAndTellsProgress) {
  BackgroundJob job;
  const int own_priority = priorityOfThisThread();
  int priority = 0, inherited = 0;
  std::vector<std::size_t> told;
  job.run(
      [&](const sks::Progress& progress) {
        EXPECT_TRUE(job.running());
        priority = priorityOfThisThread();
        std::thread([&] { inherited = priorityOfThisThread(); }).join();
        for (std::size_t i = 0; i < 3; ++i) sks::report(progress, {"work", "", i, 3});
      },
      [&](const sks::ProgressState& state) { told.push_back(state.done); });
  EXPECT_EQ(priority, 19);
  EXPECT_EQ(inherited, 19);
  EXPECT_EQ(priorityOfThisThread(), own_priority);
  EXPECT_THAT(told, ElementsAre(0u, 1u, 2u));
  EXPECT_FALSE(job.running());
  EXPECT_FALSE(job.cancel());
}

TEST(BackgroundJob, PassesOnWhatIsThrown) {
  BackgroundJob job;
  EXPECT_THROW(job.run([](const sks::Progress&) { throw std::runtime_error("no"); }, ignore), std::runtime_error);
  EXPECT_FALSE(job.running());
  EXPECT_NO_THROW(job.run([](const sks::Progress&) {}, ignore));
}

TEST(BackgroundJob, RefusesASecondOneAndCanBeCancelled) {
  BackgroundJob job;
  Endless endless(job);
  EXPECT_THAT(errorOf(ErrorCode::bad_usage, [&] { job.run([](const sks::Progress&) {}, ignore); }),
              HasSubstr("a training runs already"));
  EXPECT_TRUE(job.cancel());
  EXPECT_THAT(endless.message(), HasSubstr("work was cancelled"));
  bool done = false;
  job.run(
      [&](const sks::Progress& progress) {
        sks::report(progress, {"work", "", 0, 1});
        done = true;
      },
      ignore);
  EXPECT_TRUE(done) << "a cancelled job does not cancel the next";
}

TEST(BackgroundJob, StopsForGood) {
  BackgroundJob job;
  Endless endless(job);
  job.stop();
  EXPECT_THAT(endless.message(), HasSubstr("cancelled"));
  EXPECT_THAT(errorOf(ErrorCode::bad_usage, [&] { job.run([](const sks::Progress&) {}, ignore); }),
              HasSubstr("shuts down"));
}

TEST(BackgroundJob, LeavesACoreToOthers) {
  EXPECT_GE(BackgroundJob::threads(), 1);
  EXPECT_LE(BackgroundJob::threads(), std::max(1, int(std::thread::hardware_concurrency()) - 1));
}

}  // namespace
}  // namespace sks_detector
