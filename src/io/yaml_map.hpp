// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

namespace sks {

/// Throws Error(bad_data) with "file:line: message".
[[noreturn]] void failAt(const std::string& file, const YAML::Node& node, const std::string& message);

/// A map of a YAML file that is read strictly: a key that is unknown or stands there twice is refused, and so is a
/// value of the wrong type, each with file, line and key.
class YamlMap {
public:
  /// @param what what the map describes, for messages, e.g. "a scene"
  /// @param known every key that may stand in it
  /// @throws Error(bad_data)
  YamlMap(const YAML::Node& node, std::string file, std::string what, const std::vector<std::string>& known);

  bool has(const std::string& key) const;
  /// The value of a key. @throws Error(bad_data) if the key is not there
  YAML::Node at(const std::string& key) const;

  /// Text that is not empty.
  std::string text(const std::string& key) const;
  /// Text that is fit to be a name (nameFault()).
  std::string name(const std::string& key) const;
  /// A finite number.
  double number(const std::string& key) const;
  /// `count` finite numbers.
  std::vector<double> numbers(const std::string& key, std::size_t count) const;
  /// The items of a list; none if the key is not there or has no value.
  std::vector<YAML::Node> list(const std::string& key) const;

  /// Throws Error(bad_data) at the line of a key's value.
  [[noreturn]] void fail(const std::string& key, const std::string& message) const;
  const std::string& file() const { return file_; }
  const YAML::Node& node() const { return node_; }

private:
  YAML::Node node_;
  std::string file_;
  std::string what_;
};

}  // namespace sks
