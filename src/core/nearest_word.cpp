// SPDX-License-Identifier: BSD-3-Clause
#include "core/nearest_word.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include <sks_detector/error.hpp>
#include <sks_detector/matching.hpp>

namespace sks {
namespace {

constexpr float rounding = 1e-4f;  // above the relative error of every single precision distance and bound
const std::vector<std::size_t> level_sizes{16, 48, 128};  // merged bins; measured: each leaves about a tenth

void checkHistograms(const DescriptorMatrix& words) {
  for (std::size_t i = 0; i < words.rows() * words.cols(); ++i) {
    if (words.data()[i] >= 0 && !std::isinf(words.data()[i])) continue;
    throw Error(ErrorCode::bad_data, "codeword " + std::to_string(i / words.cols()) + " is no histogram: bin " +
                                         std::to_string(i % words.cols()) + " is " + std::to_string(words.data()[i]));
  }
}

}  // namespace

NearestWord::NearestWord(DescriptorMatrix words) : words_(std::move(words)) {
  checkHistograms(words_);
  if (words_.rows() == 0) return;
  levels_ = learnBoundCascade(words_, level_sizes);
  for (std::size_t level = 1; level < levels_.size(); ++level) {
    const std::size_t stride = levels_[level].padded();
    std::vector<float> rows(words_.rows() * stride);
    for (std::size_t i = 0; i < words_.rows(); ++i) levels_[level].apply(words_.row(i), &rows[i * stride]);
    finer_.push_back(std::move(rows));
  }
  const std::size_t size = levels_[0].size, blocks = (words_.rows() + block_words - 1) / block_words;
  coarse_.resize(blocks * block_words * size);
  std::vector<float> sums(levels_[0].padded());
  for (std::size_t slot = 0; slot < blocks * block_words; ++slot) {
    levels_[0].apply(words_.row(std::min(slot, words_.rows() - 1)), sums.data());
    float* block = &coarse_[slot / block_words * block_words * size + slot % block_words];
    for (std::size_t k = 0; k < size; ++k) block[k * block_words] = sums[k];
  }
}

float NearestWord::distanceTo(const float* query, std::uint32_t word) const {
  return chiSquaredFast(query, words_.row(word), words_.cols());
}

void NearestWord::boundCandidates(std::size_t level, Workspace& work) const {
  work.bounds.resize(work.candidates.size());
  chiSquaredRows(work.query[level].data(), levels_[level].padded(), finer_[level - 1].data(), work.candidates.data(),
                 work.candidates.size(), work.bounds.data());
}

std::pair<std::uint32_t, double> NearestWord::find(const float* query, Workspace& work) const {
  work.query.resize(levels_.size());
  for (std::size_t level = 0; level < levels_.size(); ++level) {
    work.query[level].resize(levels_[level].padded());
    levels_[level].apply(query, work.query[level].data());
  }
  work.coarse.resize(coarse_.size() / levels_[0].size);
  work.candidates.resize(words_.rows() + block_words);
  work.selected.resize(words_.rows() + block_words);
  chiSquaredBlocks(work.query[0].data(), levels_[0].size, coarse_.data(), work.coarse.size() / block_words,
                   work.coarse.data());

  // The word of the lowest bound is likely to be near: its distance rules most others out.
  float best = distanceTo(query, std::uint32_t(indexOfSmallest(work.coarse.data(), words_.rows())));
  work.candidates.resize(selectUpTo(best * (1 + rounding), work.coarse.data(), words_.rows(), work.candidates.data()));
  for (std::size_t level = 1; level < levels_.size(); ++level) {
    boundCandidates(level, work);
    const std::size_t likely = indexOfSmallest(work.bounds.data(), work.bounds.size());
    best = std::min(best, distanceTo(query, work.candidates[likely]));
    const std::size_t kept =
        selectUpTo(best * (1 + rounding), work.bounds.data(), work.bounds.size(), work.selected.data());
    for (std::size_t i = 0; i < kept; ++i) {
      work.candidates[i] = work.candidates[work.selected[i]];
      work.bounds[i] = work.bounds[work.selected[i]];
    }
    work.candidates.resize(kept);
    work.bounds.resize(kept);
  }

  // Full distances in ascending order of the bound, until no bound is below the best.
  auto& order = work.selected;
  order.resize(work.candidates.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::make_pair(work.bounds[a], a) < std::make_pair(work.bounds[b], b);
  });
  std::size_t evaluated = 0;
  for (; evaluated < order.size() && work.bounds[order[evaluated]] <= best * (1 + rounding); ++evaluated) {
    float& distance = work.bounds[order[evaluated]];
    distance = distanceTo(query, work.candidates[order[evaluated]]);
    best = std::min(best, distance);
  }

  // Between near ties double precision decides.
  std::pair<std::uint32_t, double> nearest{0, std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < evaluated; ++i) {
    if (work.bounds[order[i]] > best * (1 + rounding)) continue;
    const std::uint32_t word = work.candidates[order[i]];
    const double distance = chiSquared(query, words_.row(word), words_.cols());
    if (distance < nearest.second || (distance == nearest.second && word < nearest.first)) nearest = {word, distance};
  }
  return nearest;
}

}  // namespace sks
