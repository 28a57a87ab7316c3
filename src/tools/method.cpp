// SPDX-License-Identifier: BSD-3-Clause
#include "tools/method.hpp"

#include <algorithm>

#include <sks_detector/detector.hpp>
#include <sks_detector/error.hpp>
#include <sks_detector/settings_file.hpp>

#include "baselines/methods.hpp"
#include "core/settings/nearest_name.hpp"
#include "core/settings/shown_text.hpp"
#include "tools/share.hpp"

namespace sks::tools {
namespace {

using baselines::Method;
using baselines::methodTable;

void useWholeGrid(KeypointSettings& settings) {
  settings.detector = KeypointDetector::grid;
  settings.selection = SelectionRule::rank;
  settings.discard = 0;
}

/// Why a method cannot do a task; empty if it can.
const std::string& reasonAgainst(const Method& method, MethodTask task) {
  return task == MethodTask::scenes ? method.no_detection : method.no_classification;
}

std::vector<std::string> methodNames(MethodTask task) {
  std::vector<std::string> names{"sks", "sks-paper", "grid"};
  for (const Method& method : baselines::methods()) {
    if (reasonAgainst(method, task).empty()) names.push_back(method.name);
  }
  return names;
}

std::string methodHelp(MethodTask task) {
  std::string help =
      "sks: this detector with the given settings; sks-paper: the same, starting from the preset paper.yaml; grid: "
      "every grid keypoint, without selection";
  for (const Method& method : baselines::methods()) {
    if (reasonAgainst(method, task).empty()) help += "; " + method.name + ": " + method.help;
  }
  return help;
}

/// What is wrong with a name, for CLI11; empty for one that the task knows.
std::string checkMethodName(const std::string& name, MethodTask task) {
  const std::vector<std::string> names = methodNames(task);
  if (std::find(names.begin(), names.end(), name) != names.end()) return "";
  if (const Method* method = baselines::findMethod(name)) return name + ": " + reasonAgainst(*method, task);
  return "there is no method '" + shown(name) + "'; " + nearestNameHint(name, names);
}

bool reads(const Method& method, const SettingInfo& info) {
  const std::string group = info.key.substr(0, info.key.find('.'));
  return std::find(method.groups.begin(), method.groups.end(), group) != method.groups.end();
}

}  // namespace

void MethodOption::add(CLI::App& command, MethodTask task) {
  const std::vector<std::string> names = methodNames(task);
  std::string choices;
  for (const std::string& name : names) choices += (choices.empty() ? "{" : ",") + name;
  const auto check = [task](const std::string& name) { return checkMethodName(name, task); };
  command.add_option("--method,-m", name_, methodHelp(task))->type_name("NAME")->check(check, choices + "}");
}

void MethodOption::applyBaseline(const std::string& preset, const SettingsOptions& options, Settings& settings) {
  baselines::loadMethodSettings(sharePath(preset), settings, own_);
  const baselines::MethodSettings before = own_;
  options.apply(settings, &own_);
  for (const SettingInfo& info : methodTable().infos()) {
    if (reads(*baselines::findMethod(name_), info)) continue;
    if (methodTable().get(own_, info.key) == methodTable().get(before, info.key)) continue;
    throw Error(ErrorCode::bad_usage, "setting '" + info.key + "' has no effect on --method " + name_);
  }
}

void MethodOption::applyForScenes(const SettingsOptions& options, Settings& settings) {
  if (baselines::findMethod(name_)) {
    return applyBaseline("config/methods/" + name_ + ".yaml", options, settings);
  }
  if (name_ == "sks-paper") loadSettings(sharePath("config/paper.yaml"), settings);
  options.apply(settings);
  if (name_ == "grid") useWholeGrid(settings.keypoints);
}

void MethodOption::applyForIsolatedObjects(const SettingsOptions& options, Settings& settings) {
  if (baselines::findMethod(name_)) {
    return applyBaseline("config/methods/" + name_ + "_classify.yaml", options, settings);
  }
  if (name_ == "sks-paper") {
    settings.keypoints.discard = 0.5;  // SKS-50
    settings.matching.ambiguity = 1;
  }
  options.apply(settings);
  if (name_ == "grid") useWholeGrid(settings.keypoints);
}

DetectFunction MethodOption::detectFunction(const std::shared_ptr<const Codebook>& codebook,
                                            const Settings& settings) const {
  if (baselines::findMethod(name_)) return baselines::makeDetect(name_, codebook, settings, own_);
  const auto detector = std::make_shared<const Detector>(codebook, settings);
  return [=](const Cloud& cloud) { return detector->detect(cloud); };
}

ClassifyFunction MethodOption::classifyFunction(const std::shared_ptr<const Codebook>& codebook,
                                                const Settings& settings) const {
  const ViewKind kind = testKind(*codebook);
  if (baselines::findMethod(name_)) return baselines::makeClassify(name_, codebook, settings, own_, kind);
  const ClassBalance balance = name_ == "sks-paper" ? ClassBalance::none : ClassBalance::codewords;
  const auto classifier = std::make_shared<const Classifier>(codebook, settings, balance);
  return [=](const Cloud& cloud) { return classifier->classify(cloud, kind); };
}

void MethodOption::addSettings(nlohmann::json& settings) const {
  const Method* method = baselines::findMethod(name_);
  for (const SettingInfo& info : methodTable().infos()) {
    if (method == nullptr || !reads(*method, info)) continue;
    settings[info.key] = nlohmann::json::parse(methodTable().get(own_, info.key));
  }
}

}  // namespace sks::tools
