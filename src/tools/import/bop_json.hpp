// SPDX-License-Identifier: BSD-3-Clause
// JSON files of the BOP challenge, read with messages that name file, entry and key.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace sks::tools {

/// @throws Error(bad_file) naming the file
nlohmann::json readBopJson(const std::filesystem::path& path);

/// A value that may be wrong: `where` tells file and entry. Each function throws Error(bad_file) where it is.
struct BopNode {
  const nlohmann::json& value;
  std::string where;

  BopNode at(const std::string& key) const;
  double number() const;
  std::vector<double> numbers(std::size_t count) const;
  /// The items of a list; none where the key is not there.
  std::vector<BopNode> list(const std::string& key) const;
};

/// The number of an image or object that a key is. @throws Error(bad_file) naming the file
int bopId(const std::string& key, const std::filesystem::path& file);

}  // namespace sks::tools
