// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace sks {

/// The content of a regular file in memory of its own: a mapping of the file itself would change, or end the process by
/// SIGBUS, when somebody writes to the file or truncates it, as `cp` does. Holes and zeros take no memory.
class FileContent {
public:
  /// @param magic what the file must begin with; of one that does not, no more than that is read
  /// @throws Error(bad_file) with the system's reason, without the file's name
  explicit FileContent(const std::string& path, const std::string& magic = "");
  /// A copy of what is in memory already. @throws Error(bad_file) where there is not enough
  FileContent(const char* data, std::size_t size);
  ~FileContent();
  FileContent(const FileContent&) = delete;
  FileContent& operator=(const FileContent&) = delete;

  /// Gives the memory of some bytes back to the system: pages that lie among them are zero from then on.
  void release(std::size_t offset, std::size_t size);

  const std::uint8_t* data() const { return data_; }
  std::size_t size() const { return size_; }

private:
  void reserve(std::size_t size);

  std::uint8_t* data_ = nullptr;
  std::size_t size_ = 0, reserved_ = 0;  // [bytes] what was read; what memory there is
};

}  // namespace sks
