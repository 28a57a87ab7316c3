// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include <sks_detector/detection.hpp>
#include <sks_detector/settings.hpp>

namespace sks {

/// The lowest scores from which on detections count: one for all objects, and those of single objects in its place.
class Thresholds {
public:
  /// The same for all objects.
  explicit Thresholds(double general) : general_(general) {}
  /// `threshold`, and in its place for some objects `thresholds`. @throws Error(bad_usage) naming the part of
  /// `thresholds` that cannot be understood
  explicit Thresholds(const DetectionSettings& settings);

  double of(const std::string& object) const;
  bool passes(const Detection& detection) const { return detection.score >= of(detection.object); }
  /// Those that are not the general one, by the names of their objects.
  const std::map<std::string, double>& ofSingleObjects() const { return single_; }

private:
  double general_;
  std::map<std::string, double> single_;
};

/// What to say of names in `detection.thresholds` that are no object of a codebook: they do nothing, but the codebook
/// may be exchanged.
std::vector<std::string> thresholdWarnings(const DetectionSettings& settings, const std::vector<std::string>& objects);

}  // namespace sks
