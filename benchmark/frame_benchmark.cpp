// SPDX-License-Identifier: BSD-3-Clause
// Whole frames: organised clouds of 640 x 480 from the cloud in memory to detections, with the codebook of `kinect`.
#include <iomanip>
#include <sstream>

#include "pair.hpp"
#include "recorded_detectors.hpp"

namespace sks::bench {
namespace {

/// As a pair: what the 95th percentile may be ("theirs") and what it is.
void wholeFrames(benchmark::State& state, const char* name, double allowed_ms) {
  const auto kinect = recordedDataSet(state, "kinect"), tables = recordedDataSet(state, "clutter");
  if (!kinect || !tables) return;
  const Settings settings = preset(name, threads);
  const Detector detector(trained(*kinect, settings), settings);
  const std::vector<Cloud> clouds = sceneClouds(*tables, 10);
  for (auto _ : state) {
    detectAll(detector, clouds);
    std::vector<double> times;
    for (int round = 0; round < 5; ++round) {
      for (const Cloud& cloud : clouds) {
        times.push_back(milliseconds([&] { benchmark::DoNotOptimize(detector.detect(cloud)); }));
      }
    }
    std::sort(times.begin(), times.end());
    const double p95 = times[times.size() * 95 / 100];
    std::ostringstream label;
    label << std::fixed << std::setprecision(1) << "frames of " << clouds.size() << " scenes: p50 "
          << times[times.size() / 2] << ", p95 " << p95 << ", max " << times.back() << " ms";
    state.SetLabel(label.str());
    state.counters["theirs_ms"] = allowed_ms;
    state.counters["ours_ms"] = p95;
    state.counters["ratio"] = state.counters["cpu_ratio"] = allowed_ms / p95;
    state.counters["wanted_ratio"] = 1;
    state.SetIterationTime(p95 / 1000);
  }
}

BENCHMARK_CAPTURE(wholeFrames, default, "default", 100)->Apply(asPair);
BENCHMARK_CAPTURE(wholeFrames, fast, "fast", 50)->Apply(asPair);

}  // namespace
}  // namespace sks::bench
