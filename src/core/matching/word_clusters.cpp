// SPDX-License-Identifier: BSD-3-Clause
#include "core/matching/word_clusters.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/matching/chi_squared.hpp"

namespace sks {
namespace {

constexpr std::size_t sample_of_each = 32;  // words for each cluster that centers are learned from
constexpr int iterations = 4;               // of k-means; more do not change what is found

using Coordinates = std::array<float, code_size>;

CodedVector coded(const Coordinates& coordinates) {
  CodedVector vector;
  vector.squares = std::inner_product(coordinates.begin(), coordinates.end(), coordinates.begin(), 0.0f);
  vector.unit = std::sqrt(vector.squares) / code_length + 1e-30f;
  for (std::size_t i = 0; i < code_size; ++i) vector.code[i] = std::int16_t(std::lrint(coordinates[i] / vector.unit));
  return vector;
}

CodeTable tableOf(const std::vector<CodedVector>& vectors) {
  CodeTable table(vectors.size());
  for (std::size_t i = 0; i < vectors.size(); ++i) table.set(i, vectors[i]);
  return table;
}

/// The nearest center of every `step`-th vector.
std::vector<std::uint32_t> nearestCenters(const std::vector<CodedVector>& vectors, std::size_t step,
                                          const CodeTable& centers) {
  std::vector<std::uint32_t> nearest((vectors.size() + step - 1) / step);
  std::vector<float> distances(queries_at_once * centers.units.size());
  for (std::size_t i = 0; i < nearest.size(); i += queries_at_once) {
    std::array<const CodedVector*, queries_at_once> queries;
    std::array<float*, queries_at_once> out;
    for (std::size_t q = 0; q < queries_at_once; ++q) {
      queries[q] = &vectors[std::min(i + q, nearest.size() - 1) * step];
      out[q] = &distances[q * centers.units.size()];
    }
    codeDistances(queries, centers, 0, centers.blocks(), out);
    for (std::size_t q = 0; q < queries_at_once && i + q < nearest.size(); ++q) {
      nearest[i + q] = std::uint32_t(indexOfSmallest(out[q], centers.units.size()));
    }
  }
  return nearest;
}

/// Moves each center to the mean of its vectors; one without any stays.
void moveToMeans(const std::vector<CodedVector>& vectors, std::size_t step, const std::vector<std::uint32_t>& nearest,
                 std::vector<CodedVector>& centers) {
  std::vector<Coordinates> sums(centers.size(), Coordinates{});
  std::vector<std::size_t> counts(centers.size());
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    const CodedVector& vector = vectors[i * step];
    Coordinates& sum = sums[nearest[i]];
    for (std::size_t k = 0; k < code_size; ++k) sum[k] += vector.unit * float(vector.code[k]);
    ++counts[nearest[i]];
  }
  for (std::size_t c = 0; c < centers.size(); ++c) {
    if (counts[c] == 0) continue;
    for (float& coordinate : sums[c]) coordinate /= float(counts[c]);
    centers[c] = coded(sums[c]);
  }
}

}  // namespace

WordClusters::WordClusters(const std::vector<CodedVector>& words, std::size_t count) : first_block_{0} {
  count = std::min(count, words.size());
  if (count <= 1) {
    arrange(std::vector<std::uint32_t>(words.size(), 0));
    return;
  }
  const std::size_t step = std::max<std::size_t>(1, words.size() / (count * sample_of_each));
  std::vector<CodedVector> centers;
  for (std::size_t c = 0; c < count; ++c) centers.push_back(words[c * words.size() / count]);
  for (int i = 0; i < iterations; ++i) {
    moveToMeans(words, step, nearestCenters(words, step, tableOf(centers)), centers);
  }
  centers_ = tableOf(centers);
  arrange(nearestCenters(words, 1, centers_));
}

void WordClusters::arrange(const std::vector<std::uint32_t>& clusters_of_words) {
  const std::size_t count = std::max<std::size_t>(1, centers_.units.size());
  std::vector<std::size_t> slots(count);  // so far
  for (const std::uint32_t cluster : clusters_of_words) ++slots[cluster];
  for (std::size_t& slot : slots) {
    const std::size_t first = first_block_.back();
    first_block_.push_back(std::uint32_t(first + (slot + block_words - 1) / block_words));
    slot = first * block_words;
  }
  order_.assign(first_block_.back() * block_words, no_word);
  for (std::size_t word = 0; word < clusters_of_words.size(); ++word) {
    order_[slots[clusters_of_words[word]]++] = std::uint32_t(word);
  }
}

}  // namespace sks
