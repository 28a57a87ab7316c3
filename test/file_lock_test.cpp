// SPDX-License-Identifier: BSD-3-Clause
#include "io/file_lock.hpp"

#include <chrono>
#include <filesystem>
#include <future>
#include <thread>

#include <sys/wait.h>
#include <unistd.h>
#include <csignal>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.hpp"
#include "temporary_folder.hpp"

namespace sks {
namespace {

using test::errorOf;
using testing::AllOf;
using testing::HasSubstr;

}  // namespace

TEST(FileLock, IsWaitedForAndThenGivesUpNamingTheFolder) {
  const test::TemporaryFolder folder;
  const FileLock held(folder.path("lock"));
  const auto start = std::chrono::steady_clock::now();
  EXPECT_THAT(
      errorOf(ErrorCode::bad_file, [&] { FileLock(folder.path("lock"), 0.3); }),
      AllOf(HasSubstr("'" + folder.path() + "'"), HasSubstr("for more than 0.3 s"), HasSubstr("a folder of its own")));
  EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(300));
}

TEST(FileLock, IsTakenWhenItIsGivenBack) {
  const test::TemporaryFolder folder;
  auto held = std::make_unique<FileLock>(folder.path("lock"));
  auto other = std::async(std::launch::async, [&] { const FileLock lock(folder.path("lock"), 60); });
  EXPECT_EQ(other.wait_for(std::chrono::milliseconds(100)), std::future_status::timeout);
  held.reset();
  other.get();
}

TEST(FileLock, IsFreeOnceItsProcessWasKilled) {
  const test::TemporaryFolder folder;
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const FileLock lock(folder.path("lock"));
    if (::write(ready[1], "x", 1) == 1) ::pause();
    ::_exit(1);
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  EXPECT_THAT(errorOf(ErrorCode::bad_file, [&] { FileLock(folder.path("lock"), 0.05); }), HasSubstr("is locked"));
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  const FileLock lock(folder.path("lock"), 0);
  ::close(ready[0]);
  ::close(ready[1]);
}

TEST(FileLock, OfAFolderThatIsNotThereOrALinkIsRefused) {
  const test::TemporaryFolder folder;
  EXPECT_THAT(errorOf(ErrorCode::bad_file, [&] { FileLock(folder.path("none/lock")); }),
              HasSubstr("No such file or directory"));
  std::filesystem::create_symlink(folder.path("elsewhere"), folder.path("lock"));
  errorOf(ErrorCode::bad_file, [&] { FileLock(folder.path("lock")); });
  EXPECT_FALSE(std::filesystem::exists(folder.path("elsewhere")));
}

}  // namespace sks
