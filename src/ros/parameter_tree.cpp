// SPDX-License-Identifier: BSD-3-Clause
#include "ros/parameter_tree.hpp"

#include <algorithm>

#include <sks_detector/error.hpp>

#include "core/settings/shown_text.hpp"
#include "core/settings/value_text.hpp"

namespace sks_detector {
namespace {

using XmlRpc::XmlRpcValue;

constexpr int deepest = 16;  // maps in maps; ours need 2

struct Leaf {
  std::string key, text;
  bool scalar = true;
  bool too_deep = false;
};

Leaf leafOf(const std::string& key, XmlRpcValue& value) {
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      return {key, sks::toText(bool(value))};
    case XmlRpcValue::TypeInt:
      return {key, sks::toText(int(value))};
    case XmlRpcValue::TypeDouble:
      return {key, sks::toText(double(value))};
    case XmlRpcValue::TypeString:
      return {key, std::string(value)};
    case XmlRpcValue::TypeArray:
      return {key, "a list", false};
    case XmlRpcValue::TypeStruct:
      return {key, "a map", false};
    default:
      return {key, "nothing", false};
  }
}

/// Maps are groups, but not where a parameter has that name. One key may come twice: as `a: {b: 1}` and as `a.b: 1`.
void flatten(XmlRpcValue& tree, const std::string& prefix, int depth, const sks::SettingsOverlay& overlay,
             std::vector<Leaf>& leaves) {
  for (auto& [name, value] : tree) {
    const std::string key = prefix + name;
    if (value.getType() != XmlRpcValue::TypeStruct || overlay.isKey(key)) {
      leaves.push_back(leafOf(key, value));
    } else if (depth == deepest) {
      leaves.push_back({key, "", false, true});
    } else {
      flatten(value, key + ".", depth + 1, overlay, leaves);
    }
  }
}

}  // namespace

XmlRpcValue readParameterTree(const ros::NodeHandle& private_handle) {
  XmlRpcValue tree;
  private_handle.getParam("", tree);
  return tree;
}

TreeReading overlayParameters(XmlRpcValue tree, const std::string& name_space, sks::SettingsOverlay& overlay) {
  TreeReading reading;
  std::vector<Leaf> leaves;
  if (tree.getType() == XmlRpcValue::TypeStruct) flatten(tree, "", 1, overlay, leaves);
  const auto nameOf = [&](const std::string& key) { return name_space + "/" + withSlashes(key); };
  const auto isThere = [&](const sks::Assignment& assignment) {
    return std::any_of(leaves.begin(), leaves.end(), [&](const Leaf& leaf) {
      return leaf.key == assignment.key && leaf.text == assignment.text && leaf.scalar;
    });
  };
  for (const Leaf& leaf : leaves) {
    const std::string name = nameOf(leaf.key);
    if (leaf.too_deep) {
      reading.warnings.push_back("parameter " + name + " is ignored: it is nested too deeply");
      continue;
    }
    if (!overlay.isKey(leaf.key)) {
      const std::string nearest = overlay.nearest(leaf.key);
      reading.warnings.push_back("unknown parameter " + sks::shown(name) + " is ignored" +
                                 (nearest.empty() ? "" : ": did you mean " + nameOf(nearest) + "?"));
      continue;
    }
    const sks::Assignment wanted = overlay.resolve(leaf.key, leaf.text);
    const std::string moved = movedText(wanted);
    if (!moved.empty()) reading.warnings.push_back("parameter " + name + ": " + moved);
    if (!moved.empty() && isThere(wanted)) continue;
    try {
      if (!leaf.scalar) overlay.refuse(leaf.key, leaf.text);
      overlay.set(leaf.key, leaf.text);
      reading.given.push_back(wanted.key);
    } catch (const sks::Error& error) {
      reading.refused.push_back({wanted.key, "parameter " + name + ": " + error.what()});
    }
  }
  return reading;
}

std::string withSlashes(std::string key) {
  std::replace(key.begin(), key.end(), '.', '/');
  return key;
}

void writeParameter(const ros::NodeHandle& private_handle, const std::string& key, const std::string& type,
                    const std::string& text) {
  const std::string name = withSlashes(key);
  bool yes = false;
  int whole = 0;
  double number = 0;
  if (type == "bool" && sks::fromText(text, yes)) {
    private_handle.setParam(name, yes);
  } else if (type == "int" && sks::fromText(text, whole)) {
    private_handle.setParam(name, whole);
  } else if (type == "double" && sks::fromText(text, number)) {
    private_handle.setParam(name, number);
  } else {
    private_handle.setParam(name, text);
  }
}

}  // namespace sks_detector
