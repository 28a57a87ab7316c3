// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace sks {

/// The content of a regular file in memory of its own: a mapping of the file itself would change, or end the process by
/// SIGBUS, when somebody writes to the file or truncates it, as `cp` does. Holes and zeros take no memory.
class MappedFile {
public:
  /// @param magic what the file must begin with; of one that does not, no more than that is read
  /// @throws Error(bad_file) with the system's reason, without the file's name
  explicit MappedFile(const std::string& path, const std::string& magic = "");
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  const std::uint8_t* data() const { return data_; }
  std::size_t size() const { return size_; }

private:
  std::uint8_t* data_ = nullptr;
  std::size_t size_ = 0, mapped_ = 0;  // [bytes] what was read; what memory there is
};

}  // namespace sks
