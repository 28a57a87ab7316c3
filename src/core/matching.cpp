// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/matching.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <sks_detector/error.hpp>

#include "core/bound_table.hpp"
#include "core/chi_squared.hpp"

namespace sks {
namespace {

constexpr float rounding = 1e-4f;  // above the relative error of every single precision distance and bound
constexpr std::size_t coarse_parts = 1, fine_parts = 3;  // groups of each volume's histogram

/// A word that may still be nearest.
struct Candidate {
  float bound;
  std::uint32_t word;
  bool operator<(const Candidate& other) const {
    return bound < other.bound || (bound == other.bound && word < other.word);
  }
};

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
  DescriptorMatrix words;
  BinGroups coarse_groups, fine_groups;
  std::vector<float> coarse;  // blocks of chiSquaredBlocks(), the last one padded with the last word
  std::vector<float> fine;    // a row for each word

  std::size_t blocks() const { return (words.rows() + block_words - 1) / block_words; }
  std::size_t coarseSize() const { return coarse_groups.size() - 1; }
  std::size_t fineSize() const { return fine_groups.size() - 1; }

  explicit Index(DescriptorMatrix matrix);
  Match nearest(const float* query, std::vector<float>& bounds, std::vector<Candidate>& candidates) const;
};

Matcher::Index::Index(DescriptorMatrix matrix)
    : words(std::move(matrix)),
      coarse_groups(groupBins(words.cols(), coarse_parts)),
      fine_groups(groupBins(words.cols(), fine_parts)) {
  for (std::size_t i = 0; i < words.rows() * words.cols(); ++i) {
    if (!(words.data()[i] >= 0) || std::isinf(words.data()[i])) {
      throw Error(ErrorCode::bad_data, "codeword " + std::to_string(i / words.cols()) + " is no histogram: bin " +
                                           std::to_string(i % words.cols()) + " is " + std::to_string(words.data()[i]));
    }
  }
  coarse.resize(blocks() * block_words * coarseSize());
  fine.reserve(words.rows() * fineSize());
  for (std::size_t slot = 0; slot < blocks() * block_words; ++slot) {
    const float* word = words.row(std::min(slot, words.rows() - 1));
    const auto sums = mergeBins(word, coarse_groups);
    float* block = &coarse[slot / block_words * block_words * coarseSize() + slot % block_words];
    for (std::size_t k = 0; k < sums.size(); ++k) block[k * block_words] = sums[k];
    if (slot >= words.rows()) continue;
    const auto fine_sums = mergeBins(word, fine_groups);
    fine.insert(fine.end(), fine_sums.begin(), fine_sums.end());
  }
}

/// Coarse bounds of all words, fine bounds of those that can still win, full distances in ascending order of the fine
/// bound until none can win. The last word between near ties is spoken in double precision.
Match Matcher::Index::nearest(const float* query, std::vector<float>& bounds,
                              std::vector<Candidate>& candidates) const {
  bounds.resize(blocks() * block_words);
  const auto coarse_query = mergeBins(query, coarse_groups), fine_query = mergeBins(query, fine_groups);
  chiSquaredBlocks(coarse_query.data(), coarseSize(), coarse.data(), blocks(), bounds.data());

  const auto full = [&](std::uint32_t word) { return chiSquaredFast(query, words.row(word), words.cols()); };
  const auto first = std::min_element(bounds.begin(), bounds.begin() + words.rows());
  float best = full(std::uint32_t(first - bounds.begin()));
  candidates.clear();
  for (std::uint32_t word = 0; word < words.rows(); ++word) {
    if (bounds[word] > best * (1 + rounding)) continue;
    const float bound = chiSquaredFast(fine_query.data(), &fine[word * fineSize()], fineSize());
    if (bound <= best * (1 + rounding)) candidates.push_back({bound, word});
  }
  std::sort(candidates.begin(), candidates.end());

  std::size_t evaluated = 0;
  for (; evaluated < candidates.size() && candidates[evaluated].bound <= best * (1 + rounding); ++evaluated) {
    candidates[evaluated].bound = full(candidates[evaluated].word);
    best = std::min(best, candidates[evaluated].bound);
  }
  double exact_best = std::numeric_limits<double>::infinity();
  std::uint32_t winner = 0;
  for (std::size_t i = 0; i < evaluated; ++i) {
    if (candidates[i].bound > best * (1 + rounding)) continue;
    const double distance = chiSquared(query, words.row(candidates[i].word), words.cols());
    if (distance < exact_best || (distance == exact_best && candidates[i].word < winner)) {
      exact_best = distance;
      winner = candidates[i].word;
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
    std::vector<float> bounds;
    std::vector<Candidate> candidates;
#pragma omp for schedule(dynamic, 8)
    for (std::size_t i = 0; i < queries.rows(); ++i) {
      matches[i] = index_->nearest(queries.row(i), bounds, candidates);
      matches[i].descriptor = std::uint32_t(i);
    }
  }
  return matches;
}

}  // namespace sks
