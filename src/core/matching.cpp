// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/matching.hpp>

#include <algorithm>
#include <string>
#include <utility>

#include <sks_detector/error.hpp>

#include "core/nearest_word.hpp"

namespace sks {

double chiSquared(const float* a, const float* b, std::size_t size) {
  double sum = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const double difference = double(a[i]) - b[i], both = double(a[i]) + b[i];
    if (both > 0) sum += difference * difference / both;
  }
  return sum;
}

namespace {

constexpr std::size_t most_exact = 65536;  // codewords that `automatic` searches exactly

bool isExact(SearchKind search, std::size_t words) {
  return search == SearchKind::exact || (search == SearchKind::automatic && words <= most_exact);
}

}  // namespace

struct Matcher::Index : NearestWord {
  using NearestWord::NearestWord;
};

Matcher::Matcher(DescriptorMatrix words, SearchKind search)
    : index_(std::make_unique<Index>(std::move(words), isExact(search, words.rows()))) {}
Matcher::~Matcher() = default;
Matcher::Matcher(Matcher&&) noexcept = default;
Matcher& Matcher::operator=(Matcher&&) noexcept = default;

std::vector<Match> Matcher::match(const DescriptorMatrix& queries, int threads) const {
  const DescriptorMatrix& words = index_->words();
  if (words.rows() == 0 || queries.rows() == 0) return {};
  if (queries.cols() != words.cols()) {
    throw Error(ErrorCode::incompatible, "descriptors of " + std::to_string(queries.cols()) +
                                             " bins cannot be matched with codewords of " +
                                             std::to_string(words.cols()));
  }
  std::vector<Match> matches(queries.rows());
  const std::size_t batch = index_->batch(queries.rows(), std::size_t(threads));
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::size_t first = 0; first < queries.rows(); first += batch) {
    static thread_local NearestWord::Workspace work;  // kept from frame to frame
    index_->find(queries, first, std::min(batch, queries.rows() - first), &matches[first], work);
  }
  return matches;
}

}  // namespace sks
