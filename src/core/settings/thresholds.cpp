// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/thresholds.hpp>

#include <algorithm>

#include <sks_detector/error.hpp>

#include "core/settings/nearest_name.hpp"
#include "core/settings/shown_text.hpp"
#include "core/settings/value_text.hpp"

namespace sks {
namespace {

std::string trimmed(const std::string& text) {
  const char* blanks = " \t";
  const std::size_t begin = text.find_first_not_of(blanks);
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::vector<std::string> partsOf(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    parts.push_back(trimmed(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return parts;
}

[[noreturn]] void refusePart(const std::string& part, const std::string& reason) {
  throw Error(ErrorCode::bad_usage, "detection.thresholds: '" + shown(part) + "' " + reason);
}

}  // namespace

Thresholds::Thresholds(const DetectionSettings& settings) : general_(settings.threshold) {
  if (trimmed(settings.thresholds).empty()) return;
  for (const std::string& part : partsOf(settings.thresholds)) {
    const std::size_t equals = part.rfind('=');  // names may hold others
    const std::string name = equals == std::string::npos ? "" : trimmed(part.substr(0, equals));
    if (name.empty()) refusePart(part, "is not of the form object=score, like mug=0.7,box=0.4");
    double score = 0;
    if (!fromText(trimmed(part.substr(equals + 1)), score) || !(score >= 0 && score <= 1)) {
      refusePart(part, "must give a score of 0 to 1");
    }
    if (!single_.emplace(name, score).second) refusePart(part, "names an object that has a threshold already");
  }
}

double Thresholds::of(const std::string& object) const {
  const auto found = single_.find(object);
  return found == single_.end() ? general_ : found->second;
}

std::vector<std::string> thresholdWarnings(const DetectionSettings& settings, const std::vector<std::string>& objects) {
  const Thresholds thresholds(settings);
  std::vector<std::string> warnings;
  for (const auto& [name, score] : thresholds.ofSingleObjects()) {
    if (std::find(objects.begin(), objects.end(), name) != objects.end()) continue;
    warnings.push_back("detection.thresholds: '" + shown(name) + "' is not in the codebook; " +
                       nearestNameHint(name, objects));
  }
  return warnings;
}

}  // namespace sks
