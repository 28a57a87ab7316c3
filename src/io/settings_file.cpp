// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/settings_file.hpp>

#include <algorithm>
#include <set>
#include <sstream>

#include <sks_detector/error.hpp>

#include "core/settings/value_text.hpp"
#include "io/file.hpp"
#include "io/yaml_text.hpp"

namespace sks {
namespace {

bool isGroup(const std::string& key) {
  const auto& infos = settingInfos();
  return std::any_of(infos.begin(), infos.end(),
                     [&](const SettingInfo& info) { return info.key.rfind(key + ".", 0) == 0; });
}

/// The text of a value; of anything but a scalar what it is, which no setting takes.
std::string textOf(const YAML::Node& value) {
  if (value.IsScalar()) return value.Scalar();
  return value.IsNull() ? "nothing" : value.IsMap() ? "a map" : "a list";
}

/// Overlays the maps of one file on settings.
class Overlay {
public:
  Overlay(const std::string& origin, Settings& settings) : origin_(origin), settings_(settings) {}

  /// @param prefix of the keys in `map`: "", or a group and a dot
  void add(const YAML::Node& map, const std::string& prefix) {
    for (const auto& item : map) {
      if (!item.first.IsScalar()) fail(item.first, "a key must be plain text");
      const std::string key = prefix + item.first.Scalar();
      const bool group = isGroup(key);
      if (!seen_.insert(key).second) fail(item.first, "'" + key + "' is set twice; keep one");
      if (group && item.second.IsNull()) continue;
      if (group && !item.second.IsMap()) fail(item.first, "'" + key + "' is a group: give a map of its settings");
      if (group || (prefix.empty() && item.second.IsMap() && item.second.size() > 0)) {
        add(item.second, key + ".");  // in an unknown group the first setting tells which one was meant
      } else {
        set(item.first, key, item.second);
      }
    }
  }

  [[noreturn]] void fail(const YAML::Node& node, const std::string& message) const {
    throw Error(ErrorCode::bad_usage, origin_ + ":" + std::to_string(node.Mark().line + 1) + ": " + message);
  }

private:
  void set(const YAML::Node& key_node, const std::string& key, const YAML::Node& value) {
    try {
      setSetting(settings_, key, textOf(value));
    } catch (const Error& error) {
      fail(key_node, error.what());
    }
  }

  const std::string& origin_;
  Settings& settings_;
  std::set<std::string> seen_;
};

std::string describe(const SettingInfo& info) {
  return info.help + " (" + allowedValues(info) + (info.unit.empty() ? "" : " [" + info.unit + "]") + "; default " +
         info.default_value + (info.binding == Binding::codebook ? "; fixed by the codebook)" : ")");
}

/// A comment of whole words in lines of at most 100 characters.
std::string comment(const std::string& text, const std::string& indent) {
  std::istringstream words(text);
  std::string word, line = indent + "#", result;
  while (words >> word) {
    if (line.size() + 1 + word.size() > 100) {
      result += line + "\n";
      line = indent + "#";
    }
    line += " " + word;
  }
  return result + line + "\n";
}

}  // namespace

void loadSettings(const std::string& path, Settings& settings) {
  parseSettings(readTextFile(path), path, settings);
}

void parseSettings(const std::string& yaml, const std::string& origin, Settings& settings) {
  const YAML::Node root = parseYaml(yaml, origin);
  Settings result = settings;
  Overlay overlay(origin, result);
  if (root.IsNull()) return;
  if (!root.IsMap()) overlay.fail(root, "settings must be a map, e.g. keypoints: {discard: 0.5}");
  overlay.add(root, "");
  settings = result;
}

std::string settingsToYaml(const Settings& settings, bool comments) {
  std::string text, group;
  for (const SettingInfo& info : settingInfos()) {
    const std::size_t dot = info.key.find('.');
    const std::string info_group = dot == std::string::npos ? "" : info.key.substr(0, dot);
    if (info_group != group && !info_group.empty()) text += info_group + ":\n";
    group = info_group;
    const std::string indent = group.empty() ? "" : "  ";
    if (comments) text += comment(describe(info), indent);
    text += indent + info.key.substr(dot + 1) + ": " + getSetting(settings, info.key) + "\n";
  }
  return text;
}

}  // namespace sks
