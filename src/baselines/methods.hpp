// SPDX-License-Identifier: BSD-3-Clause
// The pipelines that the detector is compared with, composed of its stages and PCL's classes (docs/baselines.md).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <sks_detector/codebook.hpp>
#include <sks_detector/detector.hpp>
#include <sks_detector/settings.hpp>

#include "baselines/method_settings.hpp"
#include "core/pipeline/classifier.hpp"

namespace sks::baselines {

/// What a baseline is for.
struct Method {
  std::string name;
  std::vector<std::string> groups;  ///< of the method settings that it reads
  std::string no_detection;         ///< why it detects nothing in scenes; empty if it does
  std::string no_classification;    ///< why it does not classify; empty if it does
  std::string help;
};

const std::vector<Method>& methods();

/// The one of that name, or null.
const Method* findMethod(const std::string& name);

/// @param name of a method that detects @throws Error(bad_usage), Error(incompatible) like Detector
DetectFunction makeDetect(const std::string& name, const std::shared_ptr<const Codebook>& codebook,
                          const Settings& settings, const MethodSettings& own);

/// @param name of a method that classifies @param kind of the clouds @throws like Classifier
ClassifyFunction makeClassify(const std::string& name, const std::shared_ptr<const Codebook>& codebook,
                              const Settings& settings, const MethodSettings& own, ViewKind kind);

}  // namespace sks::baselines
