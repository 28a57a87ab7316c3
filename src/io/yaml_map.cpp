// SPDX-License-Identifier: BSD-3-Clause
#include "io/yaml_map.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <sks_detector/error.hpp>

#include "core/settings/name_text.hpp"
#include "core/settings/nearest_name.hpp"
#include "core/settings/shown_text.hpp"
#include "io/number_text.hpp"

namespace sks {
namespace {

/// A finite number; NaN for anything else.
double finiteNumber(const YAML::Node& node) {
  double value = 0;
  return node.IsScalar() && parseNumber(node.Scalar(), value) && std::isfinite(value) ? value : std::nan("");
}

}  // namespace

void failAt(const std::string& file, const YAML::Node& node, const std::string& message) {
  throw Error(ErrorCode::bad_data, file + ":" + std::to_string(node.Mark().line + 1) + ": " + message);
}

YamlMap::YamlMap(const YAML::Node& node, std::string file, std::string what, const std::vector<std::string>& known)
    : node_(node), file_(std::move(file)), what_(std::move(what)) {
  if (!node.IsMap()) failAt(file_, node, what_ + " must be a map with keys such as '" + known.front() + "'");
  std::set<std::string> seen;
  for (const auto& item : node) {
    const std::string key = item.first.IsScalar() ? item.first.Scalar() : "?";
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      failAt(file_, item.first, "unknown key '" + shown(key) + "' in " + what_ + "; " + nearestNameHint(key, known));
    }
    if (!seen.insert(key).second) failAt(file_, item.first, "key '" + key + "' stands twice in " + what_);
  }
}

bool YamlMap::has(const std::string& key) const {
  return node_[key].IsDefined();
}

YAML::Node YamlMap::at(const std::string& key) const {
  const YAML::Node value = node_[key];
  if (!value.IsDefined()) failAt(file_, node_, what_ + " needs the key '" + key + "'");
  return value;
}

void YamlMap::fail(const std::string& key, const std::string& message) const {
  failAt(file_, at(key), "'" + key + "' of " + what_ + " " + message);
}

std::string YamlMap::text(const std::string& key) const {
  const YAML::Node value = at(key);
  if (!value.IsScalar() || value.Scalar().empty()) fail(key, "must be text");
  return value.Scalar();
}

std::string YamlMap::name(const std::string& key) const {
  std::string value = text(key);
  const std::string fault = nameFault(value);
  if (!fault.empty()) fail(key, "is '" + shown(value, 60) + "', which is refused: " + fault);
  return value;
}

double YamlMap::number(const std::string& key) const {
  const double value = finiteNumber(at(key));
  if (std::isnan(value)) fail(key, "must be a finite number");
  return value;
}

std::vector<double> YamlMap::numbers(const std::string& key, std::size_t count) const {
  const YAML::Node value = at(key);
  std::vector<double> result;
  if (value.IsSequence()) {
    for (const auto& item : value) result.push_back(finiteNumber(item));
  }
  if (result.size() != count || std::any_of(result.begin(), result.end(), [](double v) { return std::isnan(v); })) {
    fail(key, "must be a list of " + std::to_string(count) + " finite numbers");
  }
  return result;
}

std::vector<YAML::Node> YamlMap::list(const std::string& key) const {
  const YAML::Node value = node_[key];
  if (!value.IsDefined() || value.IsNull()) return {};
  if (!value.IsSequence()) fail(key, "must be a list");
  return {value.begin(), value.end()};
}

}  // namespace sks
