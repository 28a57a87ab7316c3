// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/metrics.hpp"

#include <algorithm>
#include <cmath>

namespace sks {
namespace {

std::optional<double> ratio(double numerator, double denominator) {
  return denominator > 0 ? std::optional<double>(numerator / denominator) : std::nullopt;
}

void add(Tally& tally, const RankedDetection& detection) {
  ++(detection.true_positive ? tally.true_positives : tally.false_positives);
}

}  // namespace

std::optional<double> Tally::precision() const {
  return ratio(double(true_positives), double(true_positives + false_positives));
}

std::optional<double> Tally::recall() const {
  return ratio(double(true_positives), double(ground_truth));
}

std::optional<double> Tally::f1() const {
  if (ground_truth == 0) return std::nullopt;
  return 2.0 * double(true_positives) / double(true_positives + false_positives + ground_truth);
}

Tally tallyAt(const std::vector<RankedDetection>& detections, std::size_t ground_truth, double threshold) {
  Tally tally;
  tally.ground_truth = ground_truth;
  for (const RankedDetection& detection : detections) {
    if (detection.score >= threshold) add(tally, detection);
  }
  return tally;
}

std::vector<CurvePoint> precisionRecallCurve(std::vector<RankedDetection> detections, std::size_t ground_truth) {
  const auto better = [](const RankedDetection& a, const RankedDetection& b) { return a.score > b.score; };
  std::sort(detections.begin(), detections.end(), better);
  std::vector<CurvePoint> curve;
  Tally tally;
  tally.ground_truth = ground_truth;
  for (std::size_t i = 0; i < detections.size(); ++i) {
    add(tally, detections[i]);
    const bool last_of_score = i + 1 == detections.size() || detections[i + 1].score < detections[i].score;
    if (last_of_score) curve.push_back({detections[i].score, tally});
  }
  return curve;
}

std::optional<double> averagePrecision(const std::vector<CurvePoint>& curve, std::size_t ground_truth) {
  if (ground_truth == 0) return std::nullopt;
  double area = 0, precision = 0;
  for (std::size_t i = curve.size(); i-- > 0;) {  // from the greatest recall down, so that the maximum is at hand
    const std::size_t found_before = i > 0 ? curve[i - 1].tally.true_positives : 0;
    precision = std::max(precision, curve[i].tally.precision().value_or(0));
    area += precision * double(curve[i].tally.true_positives - found_before) / double(ground_truth);
  }
  return area;
}

std::optional<CurvePoint> bestPoint(const std::vector<CurvePoint>& curve) {
  std::optional<CurvePoint> best;
  for (const CurvePoint& point : curve) {
    const std::optional<double> f1 = point.tally.f1();
    if (f1 && (!best || *f1 > *best->tally.f1())) best = point;
  }
  return best;
}

std::vector<CurvePoint> thresholdSweep(const std::vector<RankedDetection>& detections, std::size_t ground_truth) {
  constexpr int steps = 20;
  std::vector<CurvePoint> sweep;
  for (int i = 0; i <= steps; ++i) {
    const double threshold = double(i) / steps;
    sweep.push_back({threshold, tallyAt(detections, ground_truth, threshold)});
  }
  return sweep;
}

std::optional<double> percentile(std::vector<double> values, double p) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  const double rank = p * double(values.size() - 1);
  const std::size_t below = std::size_t(std::floor(rank));
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (rank - double(below)) * (values[above] - values[below]);
}

}  // namespace sks
