// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace sks {

/// Counts over scenes, and what follows from them; a value that is undefined (0 / 0) is absent.
struct Tally {
  std::size_t ground_truth = 0;
  std::size_t true_positives = 0;
  std::size_t false_positives = 0;

  std::optional<double> precision() const;  ///< true positives / detections; absent without detections
  std::optional<double> recall() const;     ///< true positives / ground truth; absent without ground truth
  std::optional<double> f1() const;         ///< harmonic mean of both (eq. 6); absent without ground truth
};

/// A detection that has been judged, of any scene and object.
struct RankedDetection {
  double score = 0;
  bool true_positive = false;
};

/// The counts that a threshold would give.
struct CurvePoint {
  double threshold = 0;  ///< detections with at least this score count
  Tally tally;
};

/// The counts of all detections with at least the score `threshold`.
Tally tallyAt(const std::vector<RankedDetection>& detections, std::size_t ground_truth, double threshold);

/// One point for each score that occurs, highest first. Detections of equal score enter together, so the curve does not
/// depend on their order.
std::vector<CurvePoint> precisionRecallCurve(std::vector<RankedDetection> detections, std::size_t ground_truth);

/// Average precision: the area under the interpolated precision-recall curve over all its points. The precision at a
/// recall is the highest precision at that or any greater recall; the recall is relative to all ground truth, so what
/// is never found adds nothing. Absent without ground truth.
/// @param curve of precisionRecallCurve(), over the pooled detections of all scenes (and objects)
std::optional<double> averagePrecision(const std::vector<CurvePoint>& curve, std::size_t ground_truth);

/// The point of the highest F1, of equals the one with the highest threshold; absent where F1 is undefined. A threshold
/// taken from it was chosen on the very scenes that it scores: it bounds what is possible and is no result.
std::optional<CurvePoint> bestPoint(const std::vector<CurvePoint>& curve);

/// The counts at the thresholds 0, 0.05, ... 1.
std::vector<CurvePoint> thresholdSweep(const std::vector<RankedDetection>& detections, std::size_t ground_truth);

/// The value below which the fraction `p` of the values lies, by linear interpolation between the two that are nearest
/// in rank (p (n - 1), counted from 0). Absent without values.
std::optional<double> percentile(std::vector<double> values, double p);

}  // namespace sks
