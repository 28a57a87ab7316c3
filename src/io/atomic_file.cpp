// SPDX-License-Identifier: BSD-3-Clause
#include "io/atomic_file.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include <sks_detector/error.hpp>

namespace sks {
namespace {

namespace fs = std::filesystem;

std::string systemReason() {
  return std::generic_category().message(errno);
}

std::string folderOf(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? "." : folder.string();
}

/// Lets a limit on the size of files (RLIMIT_FSIZE) be an error of write() in its scope: the signal that comes with it
/// would end the process. Touches no other thread.
class NoSizeSignal {
public:
  NoSizeSignal() {
    ::sigemptyset(&signal_);
    ::sigaddset(&signal_, SIGXFSZ);
    ::pthread_sigmask(SIG_BLOCK, &signal_, &before_);
  }
  ~NoSizeSignal() {
    if (::sigismember(&before_, SIGXFSZ) == 0) {
      const timespec at_once{};
      ::sigtimedwait(&signal_, nullptr, &at_once);  // takes back what waits to be delivered
    }
    ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  NoSizeSignal(const NoSizeSignal&) = delete;
  NoSizeSignal& operator=(const NoSizeSignal&) = delete;

private:
  sigset_t signal_{}, before_{};
};

/// Makes the rename durable; where a file system cannot sync folders there is nothing more to be done.
void syncFolder(const std::string& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

std::string temporaryName(const std::string& target, const std::string& ending) {
  const fs::path path(target);
  std::string name = path.filename().string();
  const long of_folder = ::pathconf(folderOf(target).c_str(), _PC_NAME_MAX);
  const std::size_t before_name = std::min<std::size_t>(target.size() - name.size(), PATH_MAX);
  const std::size_t most =
      std::min<std::size_t>(of_folder > 0 ? std::size_t(of_folder) : NAME_MAX, PATH_MAX - before_name);
  if (name.size() <= most && name.size() + ending.size() > most && most > ending.size()) {
    std::size_t size = most - ending.size();
    while (size > 0 && (static_cast<unsigned char>(name[size]) & 0xc0) == 0x80) --size;  // whole characters
    name.resize(size);
  }
  return (path.parent_path() / (name + ending)).string();
}

AtomicFile::AtomicFile(const std::string& path) : path_(path), target_(path) {
  std::error_code ignored;
  if (path.empty()) fail("the name is empty");
  if (fs::is_directory(path, ignored)) fail("it is a folder; give the name of a file");
  const std::string folder = folderOf(path);
  if (!fs::is_directory(folder, ignored)) fail("the folder " + folder + " does not exist; create it first");
  if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored)) {
    file_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK);  // a pipe that nobody reads fails at once
    if (file_ < 0) fail(systemReason());
    ::fcntl(file_, F_SETFL, 0);
    return;
  }
  if (fs::is_symlink(path, ignored)) target_ = fs::weakly_canonical(path).string();
  static std::atomic<unsigned> count{0};
  temporary_ = temporaryName(target_, ".part" + std::to_string(::getpid()) + "_" + std::to_string(count++));
  file_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file_ < 0) {
    const int error_number = errno;
    const std::string reason = systemReason();
    temporary_.clear();
    fail(reason +
         (error_number == ENAMETOOLONG ? "; choose a shorter name" : "; choose a folder that can be written to"));
  }
}

AtomicFile::~AtomicFile() {
  if (file_ >= 0) ::close(file_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::write(const void* data, std::size_t size) {
  const NoSizeSignal no_signal;
  const char* next = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t written = ::write(file_, next, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail(systemReason());
    next += written;
    size -= std::size_t(written);
  }
}

void AtomicFile::commit() {
  if (!finishWriting()) return;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(systemReason());
  temporary_.clear();
  syncFolder(folderOf(target_));
}

bool AtomicFile::commitNew() {
  if (!finishWriting()) return true;
  if (!takeFreeName()) return false;
  syncFolder(folderOf(target_));
  return true;
}

/// @return whether the file is still to get its name
bool AtomicFile::finishWriting() {
  const bool renames = !temporary_.empty();
  if (renames && ::fsync(file_) != 0) fail(systemReason());
  const int closed = ::close(file_);
  file_ = -1;
  if (closed != 0) fail(systemReason());
  return renames;
}

/// Some file systems have one call for this and some the other; one that has neither (FUSE) leaves a gap between the
/// look and the rename.
bool AtomicFile::takeFreeName() {
  const char *from = temporary_.c_str(), *to = target_.c_str();
  if (::renameat2(AT_FDCWD, from, AT_FDCWD, to, RENAME_NOREPLACE) == 0) {
    temporary_.clear();
    return true;
  }
  if (errno == EEXIST) return false;
  if (::link(from, to) == 0) return true;  // the temporary name goes with the destructor
  if (errno == EEXIST) return false;
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(target_, ignored))) return false;
  if (::rename(from, to) != 0) fail(systemReason());
  temporary_.clear();
  return true;
}

void AtomicFile::fail(const std::string& reason) const {
  throw Error(ErrorCode::bad_file, "cannot write '" + path_ + "': " + reason);
}

}  // namespace sks
