// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/settings_file.hpp>

#include <sstream>

#include "core/settings/detector_table.hpp"
#include "core/settings/number_format.hpp"
#include "io/file.hpp"
#include "io/settings_yaml.hpp"

namespace sks {
namespace {

constexpr unsigned char first_printable = 0x20;

std::string describe(const SettingInfo& info) {
  return info.help + " (" + allowedValues(info) + "; default " +
         (info.default_value.empty() ? "empty" : info.default_value) +
         (info.binding == Binding::codebook ? "; fixed by the codebook)" : ")");
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

/// Text in double quotes, as YAML takes any.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') result += '\\';
    result += code < first_printable ? formatted("\\x%02x", code) : std::string(1, c);
  }
  return result + "\"";
}

}  // namespace

void loadSettings(const std::string& path, Settings& settings, std::vector<std::string>* warnings) {
  parseSettings(readTextFile(path), path, settings, warnings);
}

void parseSettings(const std::string& yaml, const std::string& origin, Settings& settings,
                   std::vector<std::string>* warnings) {
  Settings result = settings;
  overlayYaml(yaml, origin, SettingsOverlay({detectorTable().bind(result)}), warnings);
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
    const std::string value = getSetting(settings, info.key);
    text += indent + info.key.substr(dot + 1) + ": " + (info.type == "string" ? quoted(value) : value) + "\n";
  }
  return text;
}

}  // namespace sks
