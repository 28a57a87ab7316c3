// SPDX-License-Identifier: BSD-3-Clause
#include "ros/parameters.hpp"

#include <algorithm>
#include <utility>

#include <XmlRpcValue.h>

#include <sks_detector/error.hpp>

#include "core/value_text.hpp"

namespace sks_detector {
namespace {

using XmlRpc::XmlRpcValue;

std::string textOf(XmlRpcValue value) {
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      return sks::toText(bool(value));
    case XmlRpcValue::TypeInt:
      return sks::toText(int(value));
    case XmlRpcValue::TypeDouble:
      return sks::toText(double(value));
    case XmlRpcValue::TypeString:
      return std::string(value);
    case XmlRpcValue::TypeArray:
      return "a list";
    case XmlRpcValue::TypeStruct:
      return "a map";
    default:
      return "nothing";
  }
}

/// The leaves of a tree of parameters as text, by dotted key.
void flatten(XmlRpcValue tree, const std::string& prefix, std::map<std::string, std::string>& leaves) {
  for (auto& [name, value] : tree) {
    const std::string key = prefix + name;
    if (value.getType() == XmlRpcValue::TypeStruct && !findParameter(key)) {
      flatten(value, key + ".", leaves);
    } else {
      leaves[key] = textOf(value);
    }
  }
}

std::string parameterName(std::string key) {
  std::replace(key.begin(), key.end(), '.', '/');
  return key;
}

bool isNodeSetting(const std::string& key) {
  const auto& infos = sks::settingInfos();
  return std::none_of(infos.begin(), infos.end(), [&](const sks::SettingInfo& info) { return info.key == key; });
}

void writeParameter(const ros::NodeHandle& handle, const sks::SettingInfo& info, const std::string& text) {
  const std::string name = parameterName(info.key);
  bool yes = false;
  int whole = 0;
  double number = 0;
  if (info.type == "bool" && sks::fromText(text, yes)) {
    handle.setParam(name, yes);
  } else if (info.type == "int" && sks::fromText(text, whole)) {
    handle.setParam(name, whole);
  } else if (info.type == "double" && sks::fromText(text, number)) {
    handle.setParam(name, number);
  } else {
    handle.setParam(name, text);
  }
}

}  // namespace

ParameterReading readParameters(const ros::NodeHandle& private_handle) {
  ParameterReading reading;
  XmlRpcValue tree;
  std::map<std::string, std::string> leaves;
  if (private_handle.getParam("", tree) && tree.getType() == XmlRpcValue::TypeStruct) flatten(tree, "", leaves);

  const std::string where = private_handle.getNamespace() + "/";
  Configuration configuration;
  bool detector_usable = true;
  for (const auto& [key, text] : leaves) {
    if (!findParameter(key)) {
      reading.warnings.push_back("unknown parameter " + where + parameterName(key) + " is ignored: did you mean " +
                                 where + parameterName(nearestParameter(key)) + "?");
      continue;
    }
    try {
      setParameter(configuration, key, text);
      reading.given.push_back(key);
    } catch (const sks::Error& error) {
      reading.errors.push_back("parameter " + where + parameterName(key) + ": " + error.what());
      detector_usable = detector_usable && isNodeSetting(key);
    }
  }
  try {
    if (detector_usable) sks::validate(configuration.detector);
  } catch (const sks::Error& error) {
    reading.errors.push_back("parameters in " + where + ": " + error.what());
    detector_usable = false;
  }
  if (!detector_usable) {
    reading.errors.back() += "; all settings of the detector stay at their defaults";
    configuration.detector = sks::Settings();
  }
  reading.configuration = std::move(configuration);
  return reading;
}

void ParameterMirror::write(const Configuration& configuration) {
  for (const sks::SettingInfo& info : parameterInfos()) {
    const std::string text = getParameter(configuration, info.key);
    const auto [entry, is_new] = written_.emplace(info.key, text);
    if (!is_new && std::exchange(entry->second, text) == text) continue;
    writeParameter(private_handle_, info, text);
  }
}

}  // namespace sks_detector
