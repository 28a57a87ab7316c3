// SPDX-License-Identifier: BSD-3-Clause
#include "io/file.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

#include <sks_detector/error.hpp>

#include "io/atomic_file.hpp"
#include "io/regular_file.hpp"

namespace sks {

void writeFileAtomically(const std::string& path, const std::string& content) {
  AtomicFile file(path);
  file.write(content.data(), content.size());
  file.commit();
}

bool writeNewFileAtomically(const std::string& path, const std::string& content) {
  AtomicFile file(path);
  file.write(content.data(), content.size());
  return file.commitNew();
}

void makeFolder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw Error(ErrorCode::bad_file, "cannot make the folder '" + path + "': " + error.message());
}

void checkWritable(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored) &&
      !std::filesystem::is_directory(path, ignored)) {
    return;  // opening a pipe and closing it again would end it
  }
  const AtomicFile probe(path);
}

std::string readTextFile(const std::string& path, std::size_t max_bytes) {
  const auto fail = [&](const std::string& reason) {
    throw Error(ErrorCode::bad_file, "cannot read '" + path + "': " + reason);
  };
  std::string content;
  try {
    const RegularFile file(path);
    std::vector<char> block(1 << 16);  // grows with what is there, not with what a file says of its size
    while (const std::size_t count = file.read(block.data(), block.size(), content.size())) {
      content.append(block.data(), count);
      if (content.size() > max_bytes) break;
    }
  } catch (const Error& error) {
    fail(error.what());
  }
  if (content.size() > max_bytes) fail("it is larger than " + std::to_string(max_bytes) + " bytes");
  return content;
}

}  // namespace sks
