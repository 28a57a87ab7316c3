// SPDX-License-Identifier: BSD-3-Clause
// How the time of a frame, memory and the building of the search structure grow with the number of codewords.
#include <cmath>
#include <fstream>
#include <optional>
#include <random>

#include <unistd.h>

#include <sks_detector/stages/matching.hpp>

#include "pair.hpp"
#include "recorded_words.hpp"

namespace sks::bench {
namespace {

constexpr std::size_t compared_queries = 300;  // with an exact search

/// Recorded words, each as often as needed with its bins changed by up to a half: about as far apart as the nearest
/// words of neighbouring views.
DescriptorMatrix jittered(const DescriptorMatrix& words, std::size_t count) {
  std::mt19937 random(1);
  std::vector<float> values;
  values.reserve(count * words.cols());
  for (std::size_t i = 0; i < count; ++i) {
    const float* word = words.row(count < words.rows() ? i * words.rows() / count : i % words.rows());
    float squares = 0;
    const std::size_t first = values.size();
    for (std::size_t bin = 0; bin < words.cols(); ++bin) {
      const float change = float(random() >> 8) / float(1 << 24) - 0.5f;
      values.push_back(word[bin] == 0 ? 0 : word[bin] * (1 + change));
      squares += values.back() * values.back();
    }
    for (std::size_t bin = 0; bin < words.cols(); ++bin) values[first + bin] /= std::sqrt(squares);
  }
  return DescriptorMatrix(std::move(values), words.cols());
}

/// Memory in use.
std::size_t residentBytes() {
  std::ifstream statistics("/proc/self/statm");
  std::size_t pages = 0;
  statistics >> pages >> pages;  // the second number
  return pages * std::size_t(sysconf(_SC_PAGESIZE));
}

double shareFoundBy(const Matcher& matcher, const DescriptorMatrix& words, const DescriptorMatrix& queries) {
  const DescriptorMatrix some = someOf(queries, compared_queries);
  const auto exact = Matcher(words, SearchKind::exact).match(some, threads), found = matcher.match(some, threads);
  std::size_t equal = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) equal += found[i].word == exact[i].word;
  return double(equal) / double(exact.size());
}

void growth(benchmark::State& state) {
  const RecordedWords* recorded = recordedWords(state);
  if (recorded == nullptr) return;
  const DescriptorMatrix words = jittered(recorded->words, std::size_t(state.range(0)));
  const std::size_t before = residentBytes();
  std::optional<Matcher> matcher;
  const double building = milliseconds([&] { matcher.emplace(words); });
  const double bytes = (double(residentBytes()) - double(before)) / double(words.rows());
  matcher->match(recorded->queries, threads);  // makes its buffers
  for (auto _ : state) benchmark::DoNotOptimize(matcher->match(recorded->queries, threads));
  state.counters["build_us_per_word"] = 1000 * building / double(words.rows());
  state.counters["bytes_per_word"] = bytes;
  state.counters["share_of_codebook"] = bytes / double(words.cols() * sizeof(float));
  state.counters["share_of_nearest"] = shareFoundBy(*matcher, words, recorded->queries);
}
BENCHMARK(growth)->RangeMultiplier(10)->Range(1000, 1000000)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace sks::bench
