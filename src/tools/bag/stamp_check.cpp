// SPDX-License-Identifier: BSD-3-Clause
#include "tools/bag/stamp_check.hpp"

#include <algorithm>
#include <cmath>

#include "evaluation/metrics.hpp"
#include "tools/table.hpp"

namespace sks::tools {
namespace {

constexpr double gap_factor = 5;    // a distance of so many median ones is a gap
constexpr double least_gap = 0.5;   // [s]
constexpr double most_delay = 1.0;  // between stamp and recording [s]

std::vector<double> steps(const std::vector<ros::Time>& stamps) {
  std::vector<double> result;
  for (std::size_t i = 1; i < stamps.size(); ++i) result.push_back((stamps[i] - stamps[i - 1]).toSec());
  return result;
}

std::size_t countIf(const std::vector<double>& values, bool (*predicate)(double)) {
  return std::size_t(std::count_if(values.begin(), values.end(), predicate));
}

}  // namespace

void StampCheck::add(const ros::Time& stamp, const ros::Time& recorded) {
  stamps_.push_back(stamp);
  if (!stamp.isZero()) greatest_delay_ = std::max(greatest_delay_, std::abs((recorded - stamp).toSec()));
}

double StampCheck::rate() const {
  const double step = percentile(steps(stamps_), 0.5).value_or(0);
  return step > 0 ? 1 / step : 0;
}

void StampCheck::remark(const std::string& topic, Remarks& remarks) const {
  const auto zero = std::size_t(std::count(stamps_.begin(), stamps_.end(), ros::Time()));
  if (zero > 0) {
    remarks.push_back({Severity::warning, topic,
                       shareText(zero, stamps_.size(), "stamps") +
                           " are zero: transforms and detections cannot be matched to them; set header.stamp"});
    return;
  }
  const std::vector<double> distances = steps(stamps_);
  const std::size_t backwards = countIf(distances, [](double d) { return d < 0; });
  const std::size_t same = countIf(distances, [](double d) { return d == 0; });
  if (backwards > 0) {
    remarks.push_back({Severity::warning, topic,
                       std::to_string(backwards) + " stamps are earlier than the one before: the node starts afresh "
                                                   "each time"});
  }
  if (same > 0) remarks.push_back({Severity::warning, topic, std::to_string(same) + " stamps repeat the one before"});
  const double median = percentile(distances, 0.5).value_or(0);
  const double gap = std::max(least_gap, gap_factor * median);
  const auto gaps = std::size_t(std::count_if(distances.begin(), distances.end(), [&](double d) { return d > gap; }));
  if (gaps > 0) {
    const double longest = *std::max_element(distances.begin(), distances.end());
    remarks.push_back({Severity::note, topic,
                       std::to_string(gaps) + " gaps, the longest of " + fixed(longest, 1) + " s at " +
                           fixed(rate(), 1) + " Hz: frames are missing"});
  }
  if (greatest_delay_ > most_delay) {
    remarks.push_back(
        {Severity::warning, topic,
         "stamps are up to " + fixed(greatest_delay_, 1) + " s off the time of recording: keep ~max_input_age at 0"});
  }
}

}  // namespace sks::tools
