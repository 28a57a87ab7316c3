// SPDX-License-Identifier: BSD-3-Clause
#include "io/regular_file.hpp"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <sks_detector/error.hpp>

namespace sks {
namespace {

std::string lastReason() {
  return std::generic_category().message(errno);
}

}  // namespace

RegularFile::RegularFile(const std::string& path)
    : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {
  struct stat status {};
  std::string reason;
  if (descriptor_ < 0 || ::fstat(descriptor_, &status) != 0) {
    reason = lastReason();
  } else if (S_ISDIR(status.st_mode)) {
    reason = "it is a folder; give the name of a file";
  } else if (!S_ISREG(status.st_mode)) {
    reason = "it is no regular file but a pipe or device; copy its content to a file";
  }
  if (reason.empty()) {
    size_ = std::size_t(status.st_size);
    return;
  }
  if (descriptor_ >= 0) ::close(descriptor_);
  throw Error(ErrorCode::bad_file, reason);
}

RegularFile::~RegularFile() {
  ::close(descriptor_);
}

std::size_t RegularFile::read(void* to, std::size_t size, std::size_t offset) const {
  std::size_t done = 0;
  while (done < size) {
    const ssize_t count = ::pread(descriptor_, static_cast<char*>(to) + done, size - done, off_t(offset + done));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw Error(ErrorCode::bad_file, lastReason());
    if (count == 0) break;
    done += std::size_t(count);
  }
  return done;
}

}  // namespace sks
