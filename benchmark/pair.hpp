// SPDX-License-Identifier: BSD-3-Clause
// Pairs: the same result by another implementation ("theirs") and by ours, on the same input, in one process.
#pragma once

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

namespace sks::bench {

/// Of both sides of every pair.
constexpr int threads = 2;

inline double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

/// Wall clock time of one call [ms].
template <typename Function>
double milliseconds(Function&& f) {
  const auto start = std::chrono::steady_clock::now();
  f();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// Runs both sides in turn, once to warm up and `rounds` times, and reports medians and their ratio. The time of the
/// benchmark is ours. Where ours is far quicker it runs several times a round, so that both see the same interruptions.
template <typename Theirs, typename Ours>
void compare(benchmark::State& state, Theirs&& theirs, Ours&& ours, double wanted_ratio, int rounds = 7) {
  for (auto _ : state) {
    std::vector<double> their_times, our_times;
    theirs();
    ours();
    const int repeats = std::clamp(int(milliseconds(theirs) / milliseconds(ours) / 3), 1, 16);
    for (int round = 0; round < rounds; ++round) {
      their_times.push_back(milliseconds(theirs));
      our_times.push_back(milliseconds([&] {
                            for (int i = 0; i < repeats; ++i) ours();
                          }) /
                          repeats);
    }
    state.counters["theirs_ms"] = median(their_times);
    state.counters["ours_ms"] = median(our_times);
    state.counters["ratio"] = median(their_times) / median(our_times);
    state.counters["wanted_ratio"] = wanted_ratio;
    state.SetIterationTime(median(our_times) / 1000);
  }
}

/// Says how far both sides agree: `value` of `what`, of which at least `wanted` is asked for.
inline void reportAccuracy(benchmark::State& state, const std::string& what, double value, double wanted) {
  state.SetLabel(what);
  state.counters["accuracy"] = value;
  state.counters["wanted_accuracy"] = wanted;
}

/// BENCHMARK(f)->Apply(asPair): compare() repeats by itself.
inline void asPair(benchmark::internal::Benchmark* pair) {
  pair->Iterations(1)->UseManualTime()->Unit(benchmark::kMillisecond);
}

}  // namespace sks::bench
