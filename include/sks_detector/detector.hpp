// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>

#include <sks_detector/cloud.hpp>
#include <sks_detector/codebook.hpp>
#include <sks_detector/detection.hpp>
#include <sks_detector/settings.hpp>

namespace sks {

class ObjectMatcher;
class Verifier;

/// Finds the objects of a codebook in clouds: composes the stages of section 3.2. One instance per thread; same cloud,
/// same result, for any number of threads.
class Detector {
public:
  /// @throws Error(bad_usage) for invalid settings, Error(incompatible) naming keys and values in which `settings`
  ///         differ from what the codebook was trained with
  Detector(std::shared_ptr<const Codebook> codebook, const Settings& settings);

  /// The same codebook with other settings; shares what was built for the codebook, so that it costs nothing.
  /// @throws like the constructor
  Detector withSettings(const Settings& settings) const;

  /// @param inspection where given, is filled with what went by
  /// @throws Error(bad_data) for an unusable cloud, Error(incompatible) for a cloud without colour with CSHOT
  DetectionResult detect(const Cloud& cloud, Inspection* inspection = nullptr) const;

  const Codebook& codebook() const { return *codebook_; }
  const Settings& settings() const { return settings_; }

private:
  std::shared_ptr<const Codebook> codebook_;
  Settings settings_;
  std::shared_ptr<const ObjectMatcher> matcher_;
  std::shared_ptr<const Verifier> verifier_;
};

/// Whatever finds objects in a cloud, for example a Detector. May throw Error.
using DetectFunction = std::function<DetectionResult(const Cloud&)>;

}  // namespace sks
