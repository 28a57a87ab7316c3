// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/matching.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include <sks_detector/error.hpp>

#include "core/bound_cascade.hpp"
#include "core/chi_squared.hpp"

namespace sks {
namespace {

constexpr float rounding = 1e-4f;        // above the relative error of every single precision distance and bound
constexpr std::size_t first_looks = 32;  // words whose next bound is tried to find a near one early

}  // namespace

double chiSquared(const float* a, const float* b, std::size_t size) {
  double sum = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const double difference = double(a[i]) - b[i], both = double(a[i]) + b[i];
    if (both > 0) sum += difference * difference / both;
  }
  return sum;
}

struct Matcher::Index {
  /// Buffers of one thread.
  struct Workspace {
    std::vector<float> query[3];       // merged by each level
    std::vector<float> coarse;         // level 0 bounds of all words
    std::vector<std::uint32_t> words;  // that may still be nearest
    std::vector<float> bounds;         // of these
    std::vector<std::uint32_t> order;
  };

  DescriptorMatrix words;
  std::vector<BinMerge> levels;
  std::vector<float> coarse;    // level 0 in the layout of chiSquaredBlocks(), the last block padded with the last word
  std::vector<float> finer[2];  // levels 1 and 2, a row for each word

  std::size_t blocks() const { return (words.rows() + block_words - 1) / block_words; }
  float full(const float* query, std::uint32_t word) const {
    return chiSquaredFast(query, words.row(word), words.cols());
  }

  explicit Index(DescriptorMatrix matrix);
  void bound(std::size_t level, Workspace& work) const;
  float nearDistance(const float* query, Workspace& work) const;
  Match nearest(const float* query, Workspace& work) const;
};

Matcher::Index::Index(DescriptorMatrix matrix) : words(std::move(matrix)), levels(boundCascade(words.cols())) {
  for (std::size_t i = 0; i < words.rows() * words.cols(); ++i) {
    if (!(words.data()[i] >= 0) || std::isinf(words.data()[i])) {
      throw Error(ErrorCode::bad_data, "codeword " + std::to_string(i / words.cols()) + " is no histogram: bin " +
                                           std::to_string(i % words.cols()) + " is " + std::to_string(words.data()[i]));
    }
  }
  for (const int level : {1, 2}) {
    const std::size_t stride = levels[level].padded;
    finer[level - 1].resize(words.rows() * stride);
    for (std::size_t i = 0; i < words.rows(); ++i) levels[level].apply(words.row(i), &finer[level - 1][i * stride]);
  }
  const std::size_t size = levels[0].size;
  coarse.resize(blocks() * block_words * size);
  std::vector<float> sums(levels[0].padded);
  for (std::size_t slot = 0; slot < blocks() * block_words; ++slot) {
    levels[0].apply(words.row(std::min(slot, words.rows() - 1)), sums.data());
    float* block = &coarse[slot / block_words * block_words * size + slot % block_words];
    for (std::size_t k = 0; k < size; ++k) block[k * block_words] = sums[k];
  }
}

/// The bounds of `work.words` at one of the finer levels.
void Matcher::Index::bound(std::size_t level, Workspace& work) const {
  work.bounds.resize(work.words.size());
  chiSquaredRows(work.query[level].data(), levels[level].padded, finer[level - 1].data(), work.words.data(),
                 work.words.size(), work.bounds.data());
}

/// The full distance of a word that is likely to be near: the best of a few looks. Reads the coarse bounds.
float Matcher::Index::nearDistance(const float* query, Workspace& work) const {
  auto& looks = work.words;
  const auto lower = [&](std::uint32_t a, std::uint32_t b) { return work.coarse[a] < work.coarse[b]; };
  looks.clear();
  for (std::uint32_t word = 0; word < words.rows(); ++word) {
    if (looks.size() == first_looks) {
      if (!lower(word, looks.front())) continue;
      std::pop_heap(looks.begin(), looks.end(), lower);
      looks.pop_back();
    }
    looks.push_back(word);
    std::push_heap(looks.begin(), looks.end(), lower);
  }
  bound(2, work);
  return full(query,
              looks[std::size_t(std::min_element(work.bounds.begin(), work.bounds.end()) - work.bounds.begin())]);
}

/// Coarse bounds of all words, finer ones of those that can still win, full distances in ascending order of the finest
/// until none can win. Between near ties double precision decides.
Match Matcher::Index::nearest(const float* query, Workspace& work) const {
  for (std::size_t level = 0; level < levels.size(); ++level) {
    work.query[level].resize(levels[level].padded);
    levels[level].apply(query, work.query[level].data());
  }
  work.coarse.resize(blocks() * block_words);
  chiSquaredBlocks(work.query[0].data(), levels[0].size, coarse.data(), blocks(), work.coarse.data());
  float best = nearDistance(query, work);

  auto& candidates = work.words;
  candidates.clear();
  for (std::uint32_t word = 0; word < words.rows(); ++word) {
    if (work.coarse[word] <= best * (1 + rounding)) candidates.push_back(word);
  }
  bound(1, work);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (work.bounds[i] <= best * (1 + rounding)) candidates[kept++] = candidates[i];
  }
  candidates.resize(kept);
  bound(2, work);

  auto& order = work.order;
  order.resize(kept);
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::make_pair(work.bounds[a], a) < std::make_pair(work.bounds[b], b);
  });
  std::size_t evaluated = 0;
  for (; evaluated < kept && work.bounds[order[evaluated]] <= best * (1 + rounding); ++evaluated) {
    float& distance = work.bounds[order[evaluated]];
    distance = full(query, candidates[order[evaluated]]);
    best = std::min(best, distance);
  }
  double exact_best = std::numeric_limits<double>::infinity();
  std::uint32_t winner = 0;
  for (std::size_t i = 0; i < evaluated; ++i) {
    if (work.bounds[order[i]] > best * (1 + rounding)) continue;
    const std::uint32_t word = candidates[order[i]];
    const double distance = chiSquared(query, words.row(word), words.cols());
    if (distance < exact_best || (distance == exact_best && word < winner)) {
      exact_best = distance;
      winner = word;
    }
  }
  return {0, winner, float(exact_best)};
}

Matcher::Matcher(DescriptorMatrix words) : index_(std::make_unique<Index>(std::move(words))) {}
Matcher::~Matcher() = default;
Matcher::Matcher(Matcher&&) noexcept = default;
Matcher& Matcher::operator=(Matcher&&) noexcept = default;

std::vector<Match> Matcher::match(const DescriptorMatrix& queries, int threads) const {
  const DescriptorMatrix& words = index_->words;
  if (words.rows() == 0 || queries.rows() == 0) return {};
  if (queries.cols() != words.cols()) {
    throw Error(ErrorCode::incompatible, "descriptors of " + std::to_string(queries.cols()) +
                                             " bins cannot be matched with codewords of " +
                                             std::to_string(words.cols()));
  }
  std::vector<Match> matches(queries.rows());
#pragma omp parallel num_threads(threads)
  {
    Index::Workspace work;
#pragma omp for schedule(dynamic, 8)
    for (std::size_t i = 0; i < queries.rows(); ++i) {
      matches[i] = index_->nearest(queries.row(i), work);
      matches[i].descriptor = std::uint32_t(i);
    }
  }
  return matches;
}

}  // namespace sks
