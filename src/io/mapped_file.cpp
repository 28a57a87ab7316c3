// SPDX-License-Identifier: BSD-3-Clause
#include "io/mapped_file.hpp"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <sks_detector/error.hpp>

namespace sks {
namespace {

/// Closes a file descriptor at the end of its scope; the mapping outlives it.
struct Descriptor {
  explicit Descriptor(const std::string& path) : number(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  const int number;
};

[[noreturn]] void failBySystem() {
  throw Error(ErrorCode::bad_file, std::generic_category().message(errno));
}

}  // namespace

MappedFile::MappedFile(const std::string& path) {
  const Descriptor file(path);
  struct stat status {};
  if (file.number < 0 || ::fstat(file.number, &status) != 0) failBySystem();
  if (S_ISDIR(status.st_mode)) throw Error(ErrorCode::bad_file, "it is a folder; give the name of a file");
  if (!S_ISREG(status.st_mode)) throw Error(ErrorCode::bad_file, "it is no regular file");
  if (status.st_size == 0) return;  // cannot be mapped
  void* const data = ::mmap(nullptr, std::size_t(status.st_size), PROT_READ, MAP_PRIVATE, file.number, 0);
  if (data == MAP_FAILED) failBySystem();
  data_ = static_cast<const std::uint8_t*>(data);
  size_ = std::size_t(status.st_size);
}

MappedFile::~MappedFile() {
  if (data_) ::munmap(const_cast<std::uint8_t*>(data_), size_);
}

}  // namespace sks
