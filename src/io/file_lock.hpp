// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace sks {

/// Keeps other processes, and other threads, from a change that reads a file and writes it anew, in its scope: all that
/// take the lock of the same file wait for each other. The system gives the lock back when a process dies.
class FileLock {
public:
  /// @param path of the lock file, which is made and stays @param longest_wait [s]
  /// @throws Error(bad_file) naming the folder if the lock is not free in time, or the file cannot be made
  explicit FileLock(const std::string& path, double longest_wait = 10);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

private:
  int file_ = -1;
};

}  // namespace sks
