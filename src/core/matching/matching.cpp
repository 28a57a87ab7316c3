// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/stages/matching.hpp>

#include <utility>

#include "core/matching/nearest_word.hpp"

namespace sks {

double chiSquared(const float* a, const float* b, std::size_t size) {
  double sum = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const double difference = double(a[i]) - b[i], both = double(a[i]) + b[i];
    if (both > 0) sum += difference * difference / both;
  }
  return sum;
}

bool searchesExactly(SearchKind search, std::size_t words) {
  constexpr std::size_t most_exact = 16384;  // codewords that `automatic` searches exactly
  return search == SearchKind::exact || (search == SearchKind::automatic && words <= most_exact);
}

struct Matcher::Index : NearestWord {
  Index(const SearchedWords& words, SearchKind search)
      : NearestWord(words, searchesExactly(search, words.rows()) ? SearchEffort::exact() : SearchEffort::thorough()) {}
};

Matcher::Matcher(DescriptorMatrix words, SearchKind search)
    : index_(std::make_unique<Index>(std::move(words), search)) {}
Matcher::Matcher(QuantizedDescriptors words, SearchKind search)
    : index_(std::make_unique<Index>(std::move(words), search)) {}
Matcher::~Matcher() = default;
Matcher::Matcher(Matcher&&) noexcept = default;
Matcher& Matcher::operator=(Matcher&&) noexcept = default;

std::vector<Match> Matcher::match(const DescriptorMatrix& queries, int threads) const {
  if (index_->words().rows() == 0 || queries.rows() == 0) return {};
  return index_->find(queries, 1, threads);
}

}  // namespace sks
