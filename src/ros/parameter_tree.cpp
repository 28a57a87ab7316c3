// SPDX-License-Identifier: BSD-3-Clause
#include "ros/parameter_tree.hpp"

#include <algorithm>

#include <XmlRpcValue.h>

#include "core/settings/value_text.hpp"

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

void flatten(XmlRpcValue& tree, const std::string& prefix, const std::function<bool(const std::string&)>& is_parameter,
             std::map<std::string, std::string>& leaves) {
  for (auto& [name, value] : tree) {
    const std::string key = prefix + name;
    if (value.getType() == XmlRpcValue::TypeStruct && !is_parameter(key)) {
      flatten(value, key + ".", is_parameter, leaves);
    } else {
      leaves[key] = textOf(value);
    }
  }
}

std::string withSlashes(std::string key) {
  std::replace(key.begin(), key.end(), '.', '/');
  return key;
}

}  // namespace

std::map<std::string, std::string> readParameterTree(const ros::NodeHandle& private_handle,
                                                     const std::function<bool(const std::string& key)>& is_parameter) {
  XmlRpcValue tree;
  std::map<std::string, std::string> leaves;
  if (private_handle.getParam("", tree) && tree.getType() == XmlRpcValue::TypeStruct) {
    flatten(tree, "", is_parameter, leaves);
  }
  return leaves;
}

std::string parameterName(const ros::NodeHandle& private_handle, const std::string& key) {
  return private_handle.getNamespace() + "/" + withSlashes(key);
}

std::string unknownParameter(const ros::NodeHandle& private_handle, const std::string& key,
                             const std::string& nearest) {
  return "unknown parameter " + parameterName(private_handle, key) + " is ignored: did you mean " +
         parameterName(private_handle, nearest) + "?";
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
