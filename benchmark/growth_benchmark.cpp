// SPDX-License-Identifier: BSD-3-Clause
// How the time of a frame, memory and the building of the search structure grow with the number of codewords.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <random>

#include <unistd.h>

#include <sks_detector/stages/matching.hpp>

#include "core/descriptors/quantizer.hpp"
#include "core/matching/chi_squared.hpp"
#include "pair.hpp"
#include "recorded_words.hpp"

namespace sks::bench {
namespace {

constexpr std::size_t compared_queries = 300;  // with a plain loop over all words

/// Recorded words, each as often as needed with its bins changed by up to a half: about as far apart as the nearest
/// words of neighbouring views. Rounded, as in a codebook.
QuantizedDescriptors jittered(const DescriptorMatrix& words, std::size_t count) {
  std::mt19937 random(1);
  Quantizer rows(words.cols());
  std::vector<float> values(words.cols());
  for (std::size_t i = 0; i < count; ++i) {
    const float* word = words.row(count < words.rows() ? i * words.rows() / count : i % words.rows());
    float squares = 0;
    for (std::size_t bin = 0; bin < words.cols(); ++bin) {
      const float change = float(random() >> 8) / float(1 << 24) - 0.5f;
      values[bin] = word[bin] == 0 ? 0 : word[bin] * (1 + change);
      squares += values[bin] * values[bin];
    }
    for (float& value : values) value /= std::sqrt(squares);
    rows.add(values.data());
  }
  return rows.release();
}

/// Memory in use.
std::size_t residentBytes() {
  std::ifstream statistics("/proc/self/statm");
  std::size_t pages = 0;
  statistics >> pages >> pages;  // the second number
  return pages * std::size_t(sysconf(_SC_PAGESIZE));
}

double shareFoundBy(const Matcher& matcher, const QuantizedDescriptors& words, const DescriptorMatrix& queries) {
  const DescriptorMatrix some = someOf(queries, compared_queries);
  std::vector<float> nearest(some.rows(), std::numeric_limits<float>::infinity()), word(words.cols());
  for (std::size_t i = 0; i < words.rows(); ++i) {
    words.read(i, word.data());
    for (std::size_t q = 0; q < some.rows(); ++q) {
      nearest[q] = std::min(nearest[q], chiSquaredFast(some.row(q), word.data(), words.cols()));
    }
  }
  constexpr float rounding = 1.0001f;  // above what single precision leaves open
  std::size_t equal = 0;
  for (const Match& match : matcher.match(some, threads)) {
    equal += match.distance <= rounding * nearest[match.descriptor];
  }
  return double(equal) / double(some.rows());
}

void growth(benchmark::State& state) {
  const RecordedWords* recorded = recordedWords(state);
  if (recorded == nullptr) return;
  const QuantizedDescriptors words = jittered(recorded->words, std::size_t(state.range(0)));
  const std::size_t before = residentBytes();
  std::optional<Matcher> matcher;
  const double building = milliseconds([&] { matcher.emplace(words); });
  const double bytes = (double(residentBytes()) - double(before)) / double(words.rows());
  matcher->match(recorded->queries, threads);  // makes its buffers
  for (auto _ : state) benchmark::DoNotOptimize(matcher->match(recorded->queries, threads));
  state.counters["build_us_per_word"] = 1000 * building / double(words.rows());
  state.counters["queries"] = double(recorded->queries.rows());
  state.counters["bytes_per_word"] = bytes;
  state.counters["share_of_codebook"] = bytes / double(words.cols() + sizeof(float));
  state.counters["share_of_nearest"] = shareFoundBy(*matcher, words, recorded->queries);
}
// A search structure is built for each run: a fixed number of iterations makes it one.
BENCHMARK(growth)
    ->RangeMultiplier(10)
    ->Range(1000, 1000000)
    ->Arg(4000000)
    ->Iterations(7)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace sks::bench
