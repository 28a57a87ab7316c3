// SPDX-License-Identifier: BSD-3-Clause
#include <sstream>
#include <utility>
#include <vector>

#include <yaml-cpp/yaml.h>

#include <sks_detector/error.hpp>
#include <sks_detector/settings_file.hpp>

#include "baselines/method_settings.hpp"
#include "io/file.hpp"

namespace sks::baselines {
namespace {

/// Sets what one group says. @throws Error(bad_usage) with file and line
void applyGroup(const std::string& path, const std::string& group, const YAML::Node& map, MethodSettings& own) {
  const auto fail = [&](const YAML::Node& node, const std::string& message) {
    throw Error(ErrorCode::bad_usage, path + ":" + std::to_string(node.Mark().line + 1) + ": " + message);
  };
  if (!map.IsMap()) fail(map, "'" + group + "' is a group: give a map of its settings");
  for (const auto& item : map) {
    try {
      setMethodSetting(own, group + "." + item.first.as<std::string>(""), item.second.as<std::string>(""));
    } catch (const Error& error) {
      fail(item.first, error.what());
    }
  }
}

/// The text without the lines of some groups, which stay empty so that messages about others name the right line.
std::string without(const std::string& text, const std::vector<std::pair<int, int>>& ranges) {
  std::istringstream lines(text);
  std::string line, rest;
  for (int number = 0; std::getline(lines, line); ++number) {
    bool taken = false;
    for (const auto& [begin, end] : ranges) taken = taken || (number >= begin && number < end);
    rest += (taken ? "" : line) + "\n";
  }
  return rest;
}

}  // namespace

void loadMethodSettings(const std::string& path, Settings& settings, MethodSettings& own) {
  const std::string text = readTextFile(path);
  YAML::Node root;
  try {
    root = YAML::Load(text);
  } catch (const YAML::Exception&) {
    parseSettings(text, path, settings);  // says what is wrong
  }
  std::vector<std::pair<int, int>> taken;
  MethodSettings result = own;
  bool open = false;  // whether the last key was a method's group, whose lines end where the next key stands
  for (const auto& item : root.IsMap() ? root : YAML::Node()) {
    if (open) taken.back().second = item.first.Mark().line;
    open = item.first.IsScalar() && isMethodSetting(item.first.Scalar());
    if (!open) continue;
    taken.emplace_back(item.first.Mark().line, std::numeric_limits<int>::max());
    applyGroup(path, item.first.Scalar(), item.second, result);
  }
  parseSettings(without(text, taken), path, settings);
  own = result;
}

}  // namespace sks::baselines
