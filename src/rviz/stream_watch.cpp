// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/stream_watch.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/settings/number_format.hpp"

namespace sks_detector {
namespace {

constexpr std::chrono::seconds remembered{5};
constexpr std::size_t most_results = 2000;  // remembered at once
constexpr double furthest_stamp = 3600;     // [s] beyond it stamps are of another clock
constexpr double clock_difference = 0.05;   // [s] by which clocks of two machines may differ

/// Of at least one value.
double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::string timeText(double time) {
  return time < 1 ? sks::formatted("%.0f ms", 1000 * time) : sks::formatted("%.1f s", time);
}

}  // namespace

void StreamWatch::add(Clock::time_point now, double latency, double processing) {
  results_.push_back({now, latency, processing});
  if (results_.size() > most_results) results_.pop_front();
}

std::string StreamWatch::describe(Clock::time_point now) {
  while (!results_.empty() && now - results_.front().time > remembered) results_.pop_front();
  if (results_.empty()) return "no result in the last 5 s";
  std::vector<double> latencies, processing;
  for (const Result& result : results_) {
    latencies.push_back(result.latency);
    processing.push_back(result.processing);
  }
  std::string text = "1 result in the last 5 s";
  if (results_.size() > 1) {
    const double span = std::chrono::duration<double>(results_.back().time - results_.front().time).count();
    text = sks::formatted("%.1f results/s", double(results_.size() - 1) / std::max(span, 1e-3));
  }
  const double latency = median(latencies);
  const bool other_clock = !(latency > -clock_difference && latency < furthest_stamp);
  text += other_clock ? ", stamps of another clock" : ", " + timeText(std::max(latency, 0.0)) + " from camera to result";
  const double in_node = median(processing);
  if (std::isfinite(in_node)) text += ", " + timeText(std::max(in_node, 0.0)) + " of processing";
  return text;
}

}  // namespace sks_detector
