// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include <sys/mman.h>
#include <unistd.h>

namespace sks::fuzz {

/// A file that lies in memory and yet has a path: millions of executions write nothing to a disk.
class MemoryFile {
public:
  MemoryFile(const void* data, std::size_t size) : number_(::memfd_create("input", MFD_CLOEXEC)) {
    if (number_ < 0 || ::write(number_, data, size) != ssize_t(size)) throw std::runtime_error("no file in memory");
  }
  ~MemoryFile() { ::close(number_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(number_); }

private:
  int number_;
};

}  // namespace sks::fuzz
