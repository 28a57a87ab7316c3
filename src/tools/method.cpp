// SPDX-License-Identifier: BSD-3-Clause
#include "tools/method.hpp"

#include <sks_detector/settings_file.hpp>

#include "tools/share.hpp"

namespace sks::tools {
namespace {

void useWholeGrid(KeypointSettings& settings) {
  settings.detector = KeypointDetector::grid;
  settings.selection = SelectionRule::rank;
  settings.discard = 0;
}

}  // namespace

std::vector<std::string> methodNames() {
  return {"sks", "sks-paper", "grid"};
}

std::string methodHelp() {
  return "sks: this detector with the given settings; sks-paper: the same, starting from the preset paper.yaml; grid: "
         "every grid keypoint, without selection";
}

void applyMethod(const std::string& method, const SettingsOptions& options, Settings& settings) {
  if (method == "sks-paper") loadSettings(sharePath("config/paper.yaml"), settings);
  options.apply(settings);
  if (method == "grid") useWholeGrid(settings.keypoints);
}

void applyClassificationMethod(const std::string& method, const SettingsOptions& options, Settings& settings) {
  if (method == "sks-paper") settings.keypoints.discard = 0.5;  // SKS-50
  options.apply(settings);
  if (method == "grid") useWholeGrid(settings.keypoints);
}

}  // namespace sks::tools
