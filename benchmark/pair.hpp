// SPDX-License-Identifier: BSD-3-Clause
// Pairs: the same result by another implementation ("theirs") and by ours, on the same input, in one process.
#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>
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

/// One side of a pair: times of several runs.
struct Times {
  std::vector<double> wall;  ///< [ms]
  std::vector<double> cpu;   ///< of all threads [ms]: hardly disturbed by whatever else the machine does

  /// Mean of `repeats` runs.
  template <typename Function>
  void add(Function&& f, int repeats = 1) {
    const std::clock_t start = std::clock();
    wall.push_back(milliseconds([&] {
                     for (int i = 0; i < repeats; ++i) f();
                   }) /
                   repeats);
    cpu.push_back(1000.0 * double(std::clock() - start) / CLOCKS_PER_SEC / repeats);
  }
};

/// Runs both sides in turn, once to warm up and `rounds` times, and reports medians and their ratio. The time of the
/// benchmark is ours. Where ours is far quicker it runs several times a round, so that both see the same interruptions.
template <typename Theirs, typename Ours>
void compare(benchmark::State& state, Theirs&& theirs, Ours&& ours, double wanted_ratio, int rounds = 7) {
  for (auto _ : state) {
    theirs();
    ours();
    const int repeats = std::clamp(int(milliseconds(theirs) / milliseconds(ours) / 3), 1, 16);
    Times their_times, our_times;
    for (int round = 0; round < rounds; ++round) {
      their_times.add(theirs);
      our_times.add(ours, repeats);
    }
    state.counters["theirs_ms"] = median(their_times.wall);
    state.counters["ours_ms"] = median(our_times.wall);
    state.counters["ratio"] = median(their_times.wall) / median(our_times.wall);
    state.counters["cpu_ratio"] = median(their_times.cpu) / median(our_times.cpu);
    state.counters["wanted_ratio"] = wanted_ratio;
    state.SetIterationTime(median(our_times.wall) / 1000);
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
