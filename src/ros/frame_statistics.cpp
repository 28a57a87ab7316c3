// SPDX-License-Identifier: BSD-3-Clause
#include "ros/frame_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace sks_detector {
namespace {

constexpr std::size_t most_latencies = 300;

/// @param sorted not empty
double percentile(const std::vector<double>& sorted, double fraction) {
  const auto rank = std::size_t(std::ceil(fraction * double(sorted.size())));
  return sorted[std::max<std::size_t>(rank, 1) - 1];
}

}  // namespace

void FrameStatistics::processed(double latency, double age) {
  const std::lock_guard<std::mutex> lock(mutex_);
  latencies_.push_back(latency);
  if (latencies_.size() > most_latencies) latencies_.pop_front();
  summary_.age = age;
  ++summary_.processed;
}

void FrameStatistics::unusable() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++summary_.unusable;
}

void FrameStatistics::tooOld(double age) {
  const std::lock_guard<std::mutex> lock(mutex_);
  summary_.age = age;
  ++summary_.too_old;
}

void FrameStatistics::reset() {
  const std::lock_guard<std::mutex> lock(mutex_);
  latencies_.clear();
  summary_.age = 0;
}

FrameStatistics::Summary FrameStatistics::summary() const {
  std::vector<double> sorted;
  Summary summary;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    summary = summary_;
    sorted.assign(latencies_.begin(), latencies_.end());
  }
  summary.frames = sorted.size();
  if (sorted.empty()) return summary;
  std::sort(sorted.begin(), sorted.end());
  summary.latency_p50 = percentile(sorted, 0.5);
  summary.latency_p95 = percentile(sorted, 0.95);
  summary.latency_max = sorted.back();
  return summary;
}

}  // namespace sks_detector
