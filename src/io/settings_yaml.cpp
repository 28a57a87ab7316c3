// SPDX-License-Identifier: BSD-3-Clause
#include "io/settings_yaml.hpp"

#include <set>

#include <sks_detector/error.hpp>

#include "io/yaml_text.hpp"

namespace sks {
namespace {

class YamlOverlay {
public:
  YamlOverlay(const std::string& origin, SettingsOverlay& overlay, std::vector<std::string>* warnings)
      : origin_(origin), overlay_(overlay), warnings_(warnings) {}

  /// @param prefix of the keys in `map`: "", or a group and a dot
  void add(const YAML::Node& map, const std::string& prefix) {
    for (const auto& item : map) {
      if (!item.first.IsScalar()) fail(item.first, "a key must be plain text");
      const std::string key = prefix + item.first.Scalar();
      const bool group = overlay_.isGroup(key);
      if (group && !groups_.insert(key).second) fail(item.first, "'" + key + "' is set twice; keep one");
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
    throw Error(ErrorCode::bad_usage, placeOf(node) + message);
  }

private:
  std::string placeOf(const YAML::Node& node) const {
    return origin_ + ":" + std::to_string(node.Mark().line + 1) + ": ";
  }

  void set(const YAML::Node& key_node, const std::string& key, const YAML::Node& value) {
    try {
      if (!value.IsScalar()) overlay_.refuse(key, value.IsNull() ? "nothing" : value.IsMap() ? "a map" : "a list");
      const std::string warning = overlay_.set(key, value.Scalar());
      if (warnings_ != nullptr && !warning.empty()) warnings_->push_back(placeOf(key_node) + warning);
    } catch (const Error& error) {
      fail(key_node, error.what());
    }
  }

  const std::string& origin_;
  SettingsOverlay& overlay_;
  std::vector<std::string>* warnings_;
  std::set<std::string> groups_;
};

}  // namespace

void overlayYaml(const std::string& yaml, const std::string& origin, SettingsOverlay overlay,
                 std::vector<std::string>* warnings) {
  const YAML::Node root = parseYaml(yaml, origin);
  YamlOverlay reader(origin, overlay, warnings);
  if (root.IsNull()) return;
  if (!root.IsMap()) reader.fail(root, "settings must be a map, e.g. keypoints: {discard: 0.5}");
  reader.add(root, "");
}

}  // namespace sks
