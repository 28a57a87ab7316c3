// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace sks::test {

/// Path of a file of the recorded data: in $SKS_DATA, by default the folder shared/data beside the checkout. Empty
/// where the file is absent: skip the test then.
inline std::string recordedData(const std::string& name) {
  const char* data = std::getenv("SKS_DATA");
  const std::filesystem::path root(SKS_SOURCE_DIR);
  const auto path = (data != nullptr ? std::filesystem::path(data) : root.parent_path() / "shared/data") / name;
  return std::filesystem::exists(path) ? path.string() : std::string();
}

}  // namespace sks::test
