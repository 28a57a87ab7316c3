// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace sks {

/// A regular file that is open for reading. What is none (a pipe, a device) is refused without waiting for it: it would
/// hold a thread for good, and nothing could cancel that.
class RegularFile {
public:
  /// @throws Error(bad_file) with the system's reason, without the file's name
  explicit RegularFile(const std::string& path);
  ~RegularFile();
  RegularFile(const RegularFile&) = delete;
  RegularFile& operator=(const RegularFile&) = delete;

  int descriptor() const { return descriptor_; }
  /// [bytes] at the time of opening.
  std::size_t size() const { return size_; }
  /// As many bytes from an offset as there are, up to `size`. @throws Error(bad_file)
  std::size_t read(void* to, std::size_t size, std::size_t offset) const;

private:
  int descriptor_;
  std::size_t size_ = 0;
};

}  // namespace sks
