// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace sks {

/// A name beside the target: its own with an ending, and where that is longer than the file system takes, with the
/// begin of it alone.
std::string temporaryName(const std::string& target, const std::string& ending);

/// A file that appears whole or not at all: it is written under a temporary name in the same folder, and commit()
/// renames it. Where the path is no regular file (a pipe, a device), it is written directly.
class AtomicFile {
public:
  /// @throws Error(bad_file) naming the path and the system's reason, as do write() and commit()
  explicit AtomicFile(const std::string& path);
  /// Removes what was written unless commit() succeeded.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(const void* data, std::size_t size);

  /// Syncs the file, gives it its name in place of any older file, and syncs the folder.
  void commit();

  /// The same where no file has the name by then; else leaves that file as it is. Of several that do this at once, also
  /// in other processes, one alone gets the name.
  /// @return whether it has the name
  bool commitNew();

private:
  bool finishWriting();
  bool takeFreeName();
  [[noreturn]] void fail(const std::string& reason) const;

  std::string path_;       // as given, for messages
  std::string target_;     // with symbolic links followed
  std::string temporary_;  // empty where nothing is to be removed
  int file_ = -1;
};

}  // namespace sks
