// SPDX-License-Identifier: BSD-3-Clause
#include "tools/import/bop_json.hpp"

#include <algorithm>

#include <sks_detector/error.hpp>

#include "io/file.hpp"

namespace sks::tools {

using nlohmann::json;

json readBopJson(const std::filesystem::path& path) {
  try {
    return json::parse(readTextFile(path.string(), std::size_t(1) << 30));
  } catch (const json::exception& error) {
    throw Error(ErrorCode::bad_file, path.string() + ": not a JSON file: " + error.what());
  }
}

BopNode BopNode::at(const std::string& key) const {
  if (!value.is_object() || !value.contains(key)) {
    throw Error(ErrorCode::bad_file, where + ": the key '" + key + "' is missing");
  }
  return {value[key], where + ", " + key};
}

double BopNode::number() const {
  if (!value.is_number()) throw Error(ErrorCode::bad_file, where + ": must be a number");
  return value.get<double>();
}

std::vector<double> BopNode::numbers(std::size_t count) const {
  const bool fits = value.is_array() && value.size() == count &&
                    std::all_of(value.begin(), value.end(), [](const json& v) { return v.is_number(); });
  if (!fits) throw Error(ErrorCode::bad_file, where + ": must be a list of " + std::to_string(count) + " numbers");
  return value.get<std::vector<double>>();
}

std::vector<BopNode> BopNode::list(const std::string& key) const {
  if (!value.is_object() || !value.contains(key)) return {};
  if (!value[key].is_array()) throw Error(ErrorCode::bad_file, where + ", " + key + ": must be a list");
  std::vector<BopNode> items;
  for (const json& item : value[key]) items.push_back({item, where + ", " + key});
  return items;
}

int bopId(const std::string& key, const std::filesystem::path& file) {
  if (key.empty() || key.size() > 9 || key.find_first_not_of("0123456789") != std::string::npos) {
    throw Error(ErrorCode::bad_file, file.string() + ": '" + key + "' is no number of an image or object");
  }
  return std::stoi(key);
}

}  // namespace sks::tools
