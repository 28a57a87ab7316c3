// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <sks_detector/codebook.hpp>
#include <sks_detector/settings.hpp>

#include "baselines/method_settings.hpp"
#include "evaluation/classification.hpp"
#include "evaluation/evaluation.hpp"
#include "tools/command.hpp"

namespace sks::tools {

/// What a method is asked to do: to find objects in scenes, or to say which one an isolated object is.
enum class MethodTask { scenes, isolated_objects };

/// `--method NAME`, with the settings that only some methods have.
class MethodOption {
public:
  /// Offers those that can do the task; others are refused with the reason.
  void add(CLI::App& command, MethodTask task);

  const std::string& name() const { return name_; }

  /// Makes the settings those of the method in scenes: what it starts from, then the options, then what it fixes.
  /// @throws Error(bad_usage), Error(bad_file)
  void applyForScenes(const SettingsOptions& options, Settings& settings);

  /// The same for isolated objects: the published method then differs in its selection and in that only the nearest
  /// codeword votes, since what else it is published with suits scenes. @throws Error(bad_usage), Error(bad_file)
  void applyForIsolatedObjects(const SettingsOptions& options, Settings& settings);

  /// @throws what the constructor of Detector throws
  DetectFunction detectFunction(const std::shared_ptr<const Codebook>& codebook, const Settings& settings) const;
  /// @throws what the constructor of Classifier throws
  ClassifyFunction classifyFunction(const std::shared_ptr<const Codebook>& codebook, const Settings& settings) const;

  /// Adds the settings that only this method has, for JSON.
  void addSettings(nlohmann::json& settings) const;

private:
  void applyBaseline(const std::string& preset, const SettingsOptions& options, Settings& settings);

  std::string name_ = "sks";
  baselines::MethodSettings own_;
};

}  // namespace sks::tools
