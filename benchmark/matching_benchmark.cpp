// SPDX-License-Identifier: BSD-3-Clause
// Nearest codewords of a scene's descriptors among the 28,000 x 352 of the kinect data set.
#include <limits>

#include <flann/flann.hpp>

#include <sks_detector/stages/matching.hpp>

#include "pair.hpp"
#include "recorded_words.hpp"

namespace sks::bench {
namespace {

constexpr std::size_t plain_queries = 200;  // a plain loop takes milliseconds for each

std::vector<std::uint32_t> plainLoop(const DescriptorMatrix& words, const DescriptorMatrix& queries) {
  std::vector<std::uint32_t> found(queries.rows());
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::size_t q = 0; q < queries.rows(); ++q) {
    const float* query = queries.row(q);
    float best = std::numeric_limits<float>::infinity();
    for (std::size_t w = 0; w < words.rows(); ++w) {
      const float* word = words.row(w);
      float sum = 0;
      for (std::size_t i = 0; i < words.cols(); ++i) {
        const float difference = query[i] - word[i], both = query[i] + word[i];
        if (both > 0) sum += difference * difference / both;
      }
      if (sum >= best) continue;
      best = sum;
      found[q] = std::uint32_t(w);
    }
  }
  return found;
}

std::vector<std::uint32_t> wordsOf(const std::vector<Match>& matches) {
  std::vector<std::uint32_t> words;
  for (const Match& match : matches) words.push_back(match.word);
  return words;
}

void nearestWordPlainLoop(benchmark::State& state) {
  const RecordedWords* recorded = recordedWords(state);
  if (recorded == nullptr) return;
  const DescriptorMatrix queries = someOf(recorded->queries, plain_queries);
  const Matcher matcher(recorded->words, SearchKind::exact);
  std::vector<std::uint32_t> theirs;
  std::vector<Match> ours;
  compare(
      state, [&] { theirs = plainLoop(recorded->words, queries); }, [&] { ours = matcher.match(queries, threads); }, 20,
      3);
  std::size_t equal = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) equal += ours[i].word == theirs[i];
  reportAccuracy(state, "share of equal answers", double(equal) / double(ours.size()), 1);
}
BENCHMARK(nearestWordPlainLoop)->Apply(asPair);

void againstFlann(benchmark::State& state, SearchKind search, double wanted_ratio, double wanted_share) {
  const RecordedWords* recorded = recordedWords(state);
  if (recorded == nullptr) return;
  const DescriptorMatrix &words = recorded->words, &queries = recorded->queries;
  const auto flannMatrix = [](const DescriptorMatrix& rows) {
    return flann::Matrix<float>(const_cast<float*>(rows.data()), rows.rows(), rows.cols());
  };
  flann::Index<flann::ChiSquareDistance<float>> index(flannMatrix(words), flann::KDTreeIndexParams(4));
  index.buildIndex();
  flann::SearchParams params(128);
  params.cores = threads;
  std::vector<std::vector<std::size_t>> theirs;
  std::vector<std::vector<float>> distances;
  const Matcher matcher(words, search);
  std::vector<Match> ours;
  compare(
      state, [&] { index.knnSearch(flannMatrix(queries), theirs, distances, 1, params); },
      [&] { ours = matcher.match(queries, threads); }, wanted_ratio);
  const std::vector<Match> nearest = Matcher(words, SearchKind::exact).match(queries, threads);
  std::vector<std::uint32_t> found;
  for (const auto& one : theirs) found.push_back(std::uint32_t(one[0]));
  state.counters["their_share"] = shareOfNearest(words, queries, nearest, found);
  reportAccuracy(state, "share of nearest words found", shareOfNearest(words, queries, nearest, wordsOf(ours)),
                 wanted_share);
}

void nearestWordFlannExact(benchmark::State& state) {
  againstFlann(state, SearchKind::exact, 1, 1);
}
void nearestWordFlannApproximate(benchmark::State& state) {
  againstFlann(state, SearchKind::approximate, 3, 0.98);
}
BENCHMARK(nearestWordFlannExact)->Apply(asPair);
BENCHMARK(nearestWordFlannApproximate)->Apply(asPair);

}  // namespace
}  // namespace sks::bench
