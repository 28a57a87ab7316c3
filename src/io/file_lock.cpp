// SPDX-License-Identifier: BSD-3-Clause
#include "io/file_lock.hpp"

#include <cerrno>
#include <chrono>
#include <filesystem>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <sks_detector/error.hpp>

#include "core/settings/value_text.hpp"

namespace sks {
namespace {

using LockClock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds retry_period(10);

/// Whether there are no locks at all on the file system, so that nothing is gained by waiting.
bool knowsNoLocks(int error) {
  return error == ENOLCK || error == EOPNOTSUPP || error == ENOSYS || error == EINVAL;
}

}  // namespace

FileLock::FileLock(const std::string& path, double longest_wait)
    : file_(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666)) {
  const int open_error = errno;
  const std::string folder = std::filesystem::path(path).parent_path().string();
  const auto fail = [&](const std::string& reason) {
    if (file_ >= 0) ::close(file_);
    throw Error(ErrorCode::bad_file, "cannot change what is in '" + folder + "': " + reason);
  };
  if (file_ < 0) {
    fail("'" + path + "': " + std::generic_category().message(open_error) + "; choose a folder that can be written to");
  }
  const auto end = LockClock::now() + std::chrono::duration<double>(longest_wait);
  while (::flock(file_, LOCK_EX | LOCK_NB) != 0) {
    if (knowsNoLocks(errno)) return;
    if (errno != EWOULDBLOCK && errno != EINTR) fail("'" + path + "': " + std::generic_category().message(errno));
    if (LockClock::now() >= end) {
      fail("another program has been changing it for more than " + toText(longest_wait) + " s ('" + path +
           "' is locked): try again, or give each node a folder of its own");
    }
    std::this_thread::sleep_for(retry_period);
  }
}

FileLock::~FileLock() {
  ::close(file_);  // and so gives the lock back
}

}  // namespace sks
