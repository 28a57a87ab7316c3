// SPDX-License-Identifier: BSD-3-Clause
#include "ros/camera/camera_parameters.hpp"

#include <algorithm>

#include <XmlRpcValue.h>

#include "core/value_text.hpp"
#include "core/visit_settings.hpp"
#include "io/nearest_name.hpp"

namespace sks_detector {
namespace {

using XmlRpc::XmlRpcValue;

// What is not a value of the wanted type gives false. A whole number may stand for any number and for a text, as a
// serial number looks like one.
bool convert(XmlRpcValue& from, std::string& to) {
  if (from.getType() == XmlRpcValue::TypeInt) to = sks::toText(int(from));
  if (from.getType() == XmlRpcValue::TypeString) to = std::string(from);
  return from.getType() == XmlRpcValue::TypeInt || from.getType() == XmlRpcValue::TypeString;
}

bool convert(XmlRpcValue& from, bool& to) {
  if (from.getType() != XmlRpcValue::TypeBoolean) return false;
  to = bool(from);
  return true;
}

bool convert(XmlRpcValue& from, int& to) {
  if (from.getType() != XmlRpcValue::TypeInt) return false;
  to = int(from);
  return true;
}

bool convert(XmlRpcValue& from, double& to) {
  if (from.getType() == XmlRpcValue::TypeInt) to = int(from);
  if (from.getType() == XmlRpcValue::TypeDouble) to = double(from);
  return from.getType() == XmlRpcValue::TypeInt || from.getType() == XmlRpcValue::TypeDouble;
}

const char* expected(const std::string&) {
  return "a text";
}
const char* expected(bool) {
  return "true or false";
}
const char* expected(int) {
  return "a whole number";
}
const char* expected(double) {
  return "a number";
}

bool inRange(const std::string&, const sks::Range&) {
  return true;
}
bool inRange(double value, const sks::Range& range) {
  return value >= range.min && value <= range.max;
}

/// Takes one value over; returns what is wrong with it, or nothing.
template <typename T>
std::string take(XmlRpcValue& given, T& value, const sks::About& about) {
  T wanted{};
  if (!convert(given, wanted)) return std::string("expected ") + expected(value);
  if (!inRange(wanted, about.range)) {
    return "out of range: " + sks::toText(about.range.min) + " to " + sks::toText(about.range.max) + " [" + about.unit +
           "]";
  }
  value = wanted;
  return "";
}

}  // namespace

CameraParameters readCameraParameters(const ros::NodeHandle& private_handle) {
  CameraParameters result;
  XmlRpcValue tree;
  if (!private_handle.getParam("", tree) || tree.getType() != XmlRpcValue::TypeStruct) return result;

  const std::string prefix = private_handle.getNamespace() + "/";
  std::vector<std::string> known;
  const auto read = [&](const std::string& key, auto& value, const sks::About& about) {
    known.push_back(key);
    if (!tree.hasMember(key)) return;
    const std::string problem = take(tree[key], value, about);
    if (!problem.empty()) {
      result.problems.push_back("parameter " + prefix + key + ": " + problem + "; the default is used");
    }
  };
  CameraSettings::visit(result.settings, sks::Flatten<decltype(read)>(read));

  for (const auto& [name, value] : tree) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    result.problems.push_back("unknown parameter " + prefix + name + " is ignored: did you mean " + prefix +
                              sks::nearestName(name, known) + "?");
  }
  return result;
}

}  // namespace sks_detector
