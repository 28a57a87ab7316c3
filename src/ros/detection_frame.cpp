// SPDX-License-Identifier: BSD-3-Clause
#include "ros/detection_frame.hpp"

#include <sks_detector/error.hpp>

#include "core/settings/shown_text.hpp"
#include "ros/frame_name.hpp"

namespace sks_detector {
namespace {

const std::string object_field = "{object}", number_field = "{number}";

bool holds(const std::string& pattern, const std::string& field) {
  return pattern.find(field) != std::string::npos;
}

/// The pattern with values in the places of their fields; what a value holds is no field.
std::string filled(const std::string& pattern, const std::string& object, int number) {
  std::string text;
  for (std::size_t i = 0; i < pattern.size();) {
    if (pattern.compare(i, object_field.size(), object_field) == 0) {
      text += object;
      i += object_field.size();
    } else if (pattern.compare(i, number_field.size(), number_field) == 0) {
      text += std::to_string(number);
      i += number_field.size();
    } else {
      text += pattern[i++];
    }
  }
  return text;
}

}  // namespace

std::string detectionFrame(const NodeSettings& settings, const std::string& object, int number) {
  std::string name = filled(settings.tf_frame, object, number);
  if (number > 1 && !holds(settings.tf_frame, number_field)) name += "_" + std::to_string(number);
  return withoutSlash((settings.tf_prefix.empty() ? "" : settings.tf_prefix + "/") + name);
}

void checkFramePattern(const std::string& pattern) {
  const auto refuse = [&](const std::string& what) {
    throw sks::Error(sks::ErrorCode::bad_usage, "tf_frame = '" + sks::shown(pattern) + "' " + what);
  };
  if (!holds(pattern, object_field)) refuse("gives all objects one frame: it must hold {object}");
  if (filled(pattern, "", 0).find_first_of("{}") != std::string::npos) {
    refuse("has braces around something else than {object} or {number}");
  }
}

}  // namespace sks_detector
