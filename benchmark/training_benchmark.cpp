// SPDX-License-Identifier: BSD-3-Clause
// How time and memory of training grow with the number of training clouds.
#include <fstream>
#include <string>

#include "pair.hpp"
#include "recorded_detectors.hpp"

namespace sks::bench {
namespace {

/// Memory in use now (VmRSS) or at most since resetPeak() (VmHWM) [bytes].
double statusBytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind(key + ":", 0) == 0) return 1024 * std::stod(line.substr(key.size() + 1));
  }
  return 0;
}

void resetPeak() {
  std::ofstream("/proc/self/clear_refs") << 5;
}

double bytesOf(const Codebook& codebook) {
  double bytes = double(codebook.descriptors.rows() * codebook.descriptors.cols());
  bytes += double(codebook.words.size()) * sizeof(Codeword);
  for (const TrainingView& view : codebook.views) bytes += double(view.surface_points.size()) * 6 * sizeof(float);
  return bytes;
}

/// The training clouds of `kinect`, each as often as the argument says.
void training(benchmark::State& state) {
  const auto data_set = recordedDataSet(state, "kinect");
  if (!data_set) return;
  const auto once = trainingSamples(*data_set);
  std::vector<TrainingSample> samples;
  for (int i = 0; i < int(state.range(0)); ++i) samples.insert(samples.end(), once.begin(), once.end());
  const Settings settings = preset("default", threads);
  benchmark::DoNotOptimize(train(once, settings, "warm"));
  for (auto _ : state) {
    const double before = statusBytes("VmRSS");
    resetPeak();
    const Codebook codebook = train(samples, settings, data_set->name);
    state.counters["words"] = double(codebook.words.size());
    state.counters["codebook_MB"] = bytesOf(codebook) / 1e6;
    state.counters["peak_over_codebook"] = (statusBytes("VmHWM") - before) / bytesOf(codebook);
    state.counters["words_per_second"] =
        benchmark::Counter(double(codebook.words.size()), benchmark::Counter::kIsIterationInvariantRate);
  }
}

BENCHMARK(training)->Arg(1)->Arg(4)->Arg(16)->Iterations(1)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace sks::bench
