// SPDX-License-Identifier: BSD-3-Clause
#include "core/matching/object_matching.hpp"

#include <chrono>
#include <cmath>

#include <gtest/gtest.h>

#include "histograms.hpp"

namespace sks::test {
namespace {

/// Three objects with a view each, but for the first one, which has another one at the end; `words` go round robin.
Codebook codebookOf(const Rows& words, std::size_t size) {
  Codebook codebook;
  codebook.objects = {"a", "b", "c"};
  codebook.views.resize(4);
  for (std::uint32_t view = 0; view < 4; ++view) codebook.views[view].object = view % 3;
  for (std::size_t i = 0; i < words.size(); ++i) {
    codebook.words.push_back({});
    codebook.words.back().view = std::uint32_t(i * 4 / words.size());
  }
  codebook.descriptors = quantized(words, size);
  return codebook;
}

TEST(ObjectMatching, FindsTheNearestWordOfEachObjectThatIsNearlyAsNear) {
  const std::size_t size = 32;
  const Rows words = rounded(histograms(120, size, 3)), queries = histograms(40, size, 4);
  const Codebook codebook = codebookOf(words, size);
  const double ambiguity = 1.2;

  std::vector<Match> expected;
  for (std::uint32_t q = 0; q < queries.size(); ++q) {
    std::vector<std::pair<double, std::uint32_t>> nearest(3, {1e9, 0});
    for (std::uint32_t w = 0; w < words.size(); ++w) {
      auto& known = nearest[codebook.views[codebook.words[w].view].object];
      known = std::min(known, {plainChiSquared(queries[q], words[w]), w});
    }
    const double best = std::min({nearest[0].first, nearest[1].first, nearest[2].first});
    for (const auto& [distance, word] : nearest) {
      if (distance > ambiguity * best) continue;
      expected.push_back({q, word, float(distance), float(std::pow(best / distance, 10))});
    }
  }

  const auto matches = ObjectMatcher(codebook).match(matrix(queries, size), ambiguity, 2);
  ASSERT_EQ(matches.size(), expected.size());
  EXPECT_GT(matches.size(), queries.size());
  for (std::size_t i = 0; i < matches.size(); ++i) {
    EXPECT_EQ(matches[i].descriptor, expected[i].descriptor);
    EXPECT_EQ(matches[i].word, expected[i].word);
    EXPECT_NEAR(matches[i].distance, expected[i].distance, 1e-5);
    EXPECT_NEAR(matches[i].weight, expected[i].weight, 1e-3);
  }
}

TEST(ObjectMatching, ObjectsWithoutWordsCostNothing) {
  const std::size_t size = 32;
  const Rows words = histograms(120, size, 3), queries = histograms(400, size, 4);
  const Codebook few = codebookOf(words, size);
  Codebook many = few;
  for (int i = 0; i < 100000; ++i) many.objects.push_back("none " + std::to_string(i));
  std::swap(many.objects[1], many.objects.back());
  for (TrainingView& view : many.views) {
    if (view.object == 1)
      view.object = std::uint32_t(many.objects.size() - 1);  // the order of objects is that of matches
  }
  const auto expected = ObjectMatcher(few).match(matrix(queries, size), 1.0, 1);
  const auto start = std::chrono::steady_clock::now();
  const auto matches = ObjectMatcher(many).match(matrix(queries, size), 1.0, 1);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 1);
  ASSERT_EQ(matches.size(), expected.size());
  for (std::size_t i = 0; i < matches.size(); ++i) EXPECT_EQ(matches[i].word, expected[i].word);
}

TEST(ObjectMatching, WithoutAmbiguityEqualsTheNearestOfAll) {
  const std::size_t size = 32;
  Rows words = histograms(120, size, 3);
  words[70] = words[10];  // of equally near words the first
  Rows queries = histograms(40, size, 4);
  queries[5] = words[10];
  const auto all = Matcher(quantized(words, size)).match(matrix(queries, size), 1);
  const auto matches = ObjectMatcher(codebookOf(words, size)).match(matrix(queries, size), 1, 2);
  ASSERT_EQ(matches.size(), all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(matches[i].word, all[i].word);
    EXPECT_EQ(matches[i].distance, all[i].distance);
    EXPECT_EQ(matches[i].weight, 1);
  }
  EXPECT_EQ(matches[5].word, 10u);
}

TEST(ObjectMatching, WordsThatAreEquallyNearVoteEqually) {
  const std::size_t size = 32;
  Rows words = histograms(120, size, 3);
  words[70] = words[10];
  const auto matches = ObjectMatcher(codebookOf(words, size)).match(matrix({words[10]}, size), 1.3, 1);
  ASSERT_EQ(matches.size(), 2u);
  EXPECT_EQ(matches[0].word, 10u);
  EXPECT_EQ(matches[1].word, 70u);
  EXPECT_EQ(matches[0].weight, 1);
  EXPECT_EQ(matches[1].weight, 1);
}

TEST(ObjectMatching, NoWordsNoMatches) {
  EXPECT_TRUE(ObjectMatcher(Codebook()).match(matrix(histograms(3, 32, 4), 32), 1.3, 1).empty());
}

}  // namespace
}  // namespace sks::test
