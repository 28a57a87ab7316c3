// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include <sks_detector/cloud.hpp>
#include <sks_detector/codebook.hpp>
#include <sks_detector/detection.hpp>
#include <sks_detector/settings.hpp>
#include <sks_detector/stages/stages.hpp>

namespace sks {

class NearestWord;
class ObjectMatcher;
struct VerifiedModels;

/// Finds the objects of a codebook in clouds: composes the stages of section 3.2. Immutable but for assignment: several
/// threads may call detect() of one Detector at the same time. Same cloud, same result, for any number of threads and
/// whatever else is detected meanwhile.
class Detector {
public:
  /// With the settings that the codebook was trained with.
  explicit Detector(std::shared_ptr<const Codebook> codebook);
  explicit Detector(Codebook codebook);

  /// @param codebook of readCodebook() or train(); not null
  /// @param stages in place of this package's own; null ones are those that the settings ask for
  /// @throws Error(bad_usage) for invalid settings, Error(incompatible) naming keys and values in which `settings`
  ///         differ from what the codebook was trained with, or its descriptors from those of the stages;
  ///         Error(bad_usage) where threads cannot be started
  Detector(std::shared_ptr<const Codebook> codebook, const Settings& settings, const Stages& stages = {});
  Detector(Codebook codebook, const Settings& settings, const Stages& stages = {});

  /// The same codebook and stages with other settings; shares what was built for the codebook, so that it costs next
  /// to nothing: but where `matching.background` is switched on, its words may have to be made, in a quarter of a
  /// second. @throws like the constructor
  Detector withSettings(const Settings& settings) const;

  /// @param cloud in metres, in any frame; its sensor_origin is where it was seen from
  /// @param inspection where given, is filled with the intermediate results
  /// @param occupied where objects are known to be: there is no search there
  /// @return detections in the frame of the cloud, best first, whatever their score; see DetectionResult::above()
  /// @throws Error(bad_data) for an unusable cloud, Error(incompatible) for a cloud without colour with CSHOT
  DetectionResult detect(const Cloud& cloud, Inspection* inspection = nullptr,
                         const std::vector<OccupiedBox>& occupied = {}) const;

  const Codebook& codebook() const { return *codebook_; }
  const Settings& settings() const { return settings_; }

private:
  friend class Tracker;

  const VerifierStage& verifier() const;
  void findBackground();

  std::shared_ptr<const Codebook> codebook_;
  Settings settings_;
  Stages stages_;  // the verifier only where it is the user's
  std::shared_ptr<const ObjectMatcher> matcher_;
  std::shared_ptr<const NearestWord> background_;  // none: nothing competes with the codebook
  std::shared_ptr<const VerifiedModels> models_;   // none: the verifier is the user's
  std::shared_ptr<const VerifierStage> surface_verifier_, hough_verifier_;
};

/// Whatever finds objects in a cloud, for example a Detector. May throw Error.
using DetectFunction = std::function<DetectionResult(const Cloud&)>;

}  // namespace sks
