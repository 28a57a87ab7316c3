// SPDX-License-Identifier: BSD-3-Clause
#include "core/matching/word_codes.hpp"

#include <numeric>

#include <gtest/gtest.h>

#include "core/matching/merged_words.hpp"
#include "histograms.hpp"

using sks::test::Rows;

namespace {

std::vector<std::uint32_t> inOrder(std::size_t count) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  return order;
}

struct Coded {
  sks::WordCodes codes;
  sks::CodeTable table;

  explicit Coded(const Rows& words) : table(words.size()) {
    const sks::DescriptorMatrix matrix = sks::test::matrix(words, words[0].size());
    codes = sks::WordCodes(matrix);
    const auto vectors = codes.encode(matrix);
    for (std::size_t w = 0; w < words.size(); ++w) table.set(w, vectors[w]);
  }
};

/// Bounds of the distances of up to four queries to all words.
Rows boundsOf(const sks::CodeTable& table, const std::vector<sks::WordCodes::CodedQuery>& queries) {
  Rows bounds(sks::queries_at_once, std::vector<float>(table.blocks() * sks::block_words));
  std::array<const sks::CodedVector*, sks::queries_at_once> vectors;
  std::array<float*, sks::queries_at_once> out;
  for (std::size_t q = 0; q < sks::queries_at_once; ++q) {
    vectors[q] = &queries[std::min(q, queries.size() - 1)].vector;
    out[q] = bounds[q].data();
  }
  sks::codeDistances(vectors, table, 0, table.blocks(), out);
  return bounds;
}

/// Some like the words, some unlike, some empty or out of scale.
Rows oddQueries(const Rows& words) {
  Rows queries = sks::test::histograms(4, words[0].size(), 7, 0.1);
  queries.insert(queries.end(), words.begin(), words.begin() + 4);
  queries.push_back(std::vector<float>(words[0].size(), 0.0f));
  for (const float scale : {1e-12f, 1e-3f, 1e3f}) {
    queries.push_back(words[1]);
    for (float& bin : queries.back()) bin *= scale;
  }
  return queries;
}

}  // namespace

class WordCodes : public testing::TestWithParam<std::size_t> {};

TEST_P(WordCodes, BoundsAreNotAboveDistances) {
  Rows words = sks::test::histograms(100, GetParam(), 1);
  words.push_back(std::vector<float>(GetParam(), 0.0f));
  const Coded codes(words);
  sks::HellingerAxes::Projection projection;
  for (const auto& query : oddQueries(words)) {
    std::vector<sks::WordCodes::CodedQuery> coded(1);
    codes.codes.encode(query.data(), projection, coded[0]);
    const auto bounds = boundsOf(codes.table, coded)[0];
    for (std::size_t w = 0; w < words.size(); ++w) {
      const double distance = sks::test::plainChiSquared(query, words[w]);
      EXPECT_LE(bounds[w], distance * (1 + 1e-5) + coded[0].slack) << "word " << w;
    }
    for (std::size_t w = words.size(); w < bounds.size(); ++w) EXPECT_EQ(bounds[w], INFINITY);
  }
}

TEST_P(WordCodes, BoundsComeNearDistances) {                    // else nothing would be ruled out
  const Rows words = sks::test::histograms(60, GetParam(), 2);  // no more than there are axes
  const Coded codes(words);
  sks::HellingerAxes::Projection projection;
  std::vector<sks::WordCodes::CodedQuery> coded(1);
  codes.codes.encode(words[3].data(), projection, coded[0]);
  const auto bounds = boundsOf(codes.table, coded)[0];
  EXPECT_LT(coded[0].slack, 0.02 * sks::test::plainChiSquared(words[3], words[4]));
  for (std::size_t w = 0; w < words.size(); ++w) {
    EXPECT_GE(bounds[w] + coded[0].slack, 0.5 * sks::test::plainChiSquared(words[3], words[w])) << "word " << w;
  }
}

TEST_P(WordCodes, QueriesDoNotDependOnEachOther) {
  const Rows words = sks::test::histograms(50, GetParam(), 3);
  const Coded codes(words);
  sks::HellingerAxes::Projection projection;
  std::vector<sks::WordCodes::CodedQuery> coded(sks::queries_at_once);
  for (std::size_t q = 0; q < coded.size(); ++q) codes.codes.encode(words[5 * q].data(), projection, coded[q]);
  const Rows together = boundsOf(codes.table, coded);
  for (std::size_t q = 0; q < coded.size(); ++q) EXPECT_EQ(together[q], boundsOf(codes.table, {coded[q]})[0]);
}

TEST_P(WordCodes, MergedBoundsAreNotAboveDistances) {
  Rows words = sks::test::histograms(100, GetParam(), 4);
  words.push_back(std::vector<float>(GetParam(), 0.0f));
  const auto order = inOrder(words.size());
  const sks::MergedWords merged(sks::test::matrix(words, GetParam()), order);
  for (const auto& query : oddQueries(words)) {
    std::vector<float> merged_query, bounds;
    merged.merge(query.data(), merged_query);
    merged.distances(merged_query, order, bounds);
    for (std::size_t w = 0; w < words.size(); ++w) {
      const auto distance = float(sks::test::plainChiSquared(query, words[w]));
      EXPECT_LE(bounds[w], merged.highestWithin(distance) * (1 + 1e-5f)) << "word " << w;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, WordCodes, testing::Values(7u, 33u, 63u, 352u, 1344u));
