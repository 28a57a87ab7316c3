// SPDX-License-Identifier: BSD-3-Clause
#include "tools/import/unibo_ini.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <sstream>

#include <sks_detector/error.hpp>

#include "io/file.hpp"
#include "io/number_text.hpp"

namespace sks::tools {
namespace {

namespace fs = std::filesystem;

std::string trimmed(const std::string& text) {
  const char* blanks = " \t\r\"";
  const std::size_t begin = text.find_first_not_of(blanks);
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

/// Values by "SECTION.KEY", in capitals.
std::map<std::string, std::string> readIni(const std::string& path) {
  std::map<std::string, std::string> values;
  std::istringstream text = plainStream(readTextFile(path));
  std::string section;
  for (std::string line; std::getline(text, line);) {
    line = trimmed(line);
    const std::size_t equals = line.find('=');
    if (line.empty() || line[0] == ';' || line[0] == '#') continue;
    const bool is_section = line[0] == '[' && line.back() == ']';
    std::string key = is_section ? line.substr(1, line.size() - 2) : trimmed(line.substr(0, equals));
    std::transform(key.begin(), key.end(), key.begin(), [](unsigned char c) { return char(std::toupper(c)); });
    if (is_section) {
      section = key;
    } else if (equals != std::string::npos) {
      values[section + "." + key] = trimmed(line.substr(equals + 1));
    }
  }
  return values;
}

/// Where a path of the file is on this machine; empty where it is nowhere.
std::string resolve(std::string value, const fs::path& file, const fs::path& root) {
  std::replace(value.begin(), value.end(), '\\', '/');
  const fs::path top = fs::weakly_canonical(root);
  for (fs::path folder = fs::weakly_canonical(file).parent_path();; folder = folder.parent_path()) {
    for (fs::path rest(value); !rest.empty();) {
      const fs::path candidate = (folder / rest).lexically_normal();
      if (fs::is_regular_file(candidate)) return candidate.string();
      fs::path shorter;
      for (auto part = std::next(rest.begin()); part != rest.end(); ++part) shorter /= *part;
      rest = shorter;
    }
    if (folder == top || !folder.has_relative_path()) return "";
  }
}

}  // namespace

std::optional<UniboScene> readUniboIni(const std::string& path, const std::string& root) {
  const std::map<std::string, std::string> values = readIni(path);
  if (values.count("SCENE.PATH") == 0 || values.count("MODELS.NUMBER") == 0) return std::nullopt;
  const auto file = [&](const std::string& key) {
    const auto value = values.find(key);
    if (value == values.end()) throw Error(ErrorCode::bad_file, path + ": the key " + key + " is missing");
    std::string found = resolve(value->second, path, root);
    if (found.empty()) {
      throw Error(ErrorCode::bad_file,
                  path + ": " + key + " names '" + value->second + "', which is nowhere in '" + root + "'");
    }
    return found;
  };
  UniboScene scene;
  scene.cloud = file("SCENE.PATH");
  int count = 0;
  std::istringstream number = plainStream(values.at("MODELS.NUMBER"));
  if (!(number >> count) || count < 0) {
    throw Error(ErrorCode::bad_file, path + ": MODELS.NUMBER is '" + number.str() + "', not a count");
  }
  for (int i = 0; i < count; ++i) {
    const std::string key = "MODELS.MODEL_" + std::to_string(i);
    scene.models.push_back({file(key), file(key + "_GROUNDTRUTH")});
  }
  return scene;
}

}  // namespace sks::tools
