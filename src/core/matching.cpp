// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/matching.hpp>

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

struct Matcher::Index : NearestWord {
  using NearestWord::NearestWord;
};

Matcher::Matcher(DescriptorMatrix words) : index_(std::make_unique<Index>(std::move(words))) {}
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
#pragma omp parallel num_threads(threads)
  {
    NearestWord::Workspace work;
#pragma omp for schedule(dynamic, 8)
    for (std::size_t i = 0; i < queries.rows(); ++i) {
      const auto [word, distance] = index_->find(queries.row(i), work);
      matches[i] = {std::uint32_t(i), word, float(distance)};
    }
  }
  return matches;
}

}  // namespace sks
