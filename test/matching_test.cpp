// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/stages/matching.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gmock/gmock.h>

#include "core/matching/bound_cascade.hpp"
#include "core/matching/chi_squared.hpp"
#include "error_of.hpp"
#include "histograms.hpp"

using sks::test::histogram;
using sks::test::histograms;
using sks::test::matrix;
using sks::test::plainChiSquared;
using sks::test::Rows;
using sks::test::uniform;
using testing::HasSubstr;

namespace {

/// Every match is the first of the nearest words of a plain loop in double precision.
void expectExact(const Rows& words, const Rows& queries, std::size_t size) {
  const auto matches = sks::Matcher(matrix(words, size)).match(matrix(queries, size), 2);
  ASSERT_EQ(matches.size(), queries.size());
  for (std::size_t q = 0; q < queries.size(); ++q) {
    std::size_t nearest = 0;
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t w = 0; w < words.size(); ++w) {
      const double distance = plainChiSquared(queries[q], words[w]);
      if (distance < best) {
        best = distance;
        nearest = w;
      }
    }
    EXPECT_EQ(matches[q].descriptor, q);
    ASSERT_EQ(matches[q].word, nearest) << "query " << q << " of size " << size << " at " << best;
    EXPECT_NEAR(matches[q].distance, best, 1e-5 * best + 1e-12);
  }
}

}  // namespace

TEST(ChiSquared, EqualsTheFormula) {
  const float a[] = {0.5f, 0, 1, 0}, b[] = {0.25f, 2, 1, 0};
  EXPECT_DOUBLE_EQ(sks::chiSquared(a, b, 4), 0.0625 / 0.75 + 2);
  for (const std::size_t size : {1u, 7u, 352u, 1344u}) {
    const Rows rows = histograms(2, size, 5);
    EXPECT_DOUBLE_EQ(sks::chiSquared(rows[0].data(), rows[1].data(), size), plainChiSquared(rows[0], rows[1]));
    EXPECT_EQ(sks::chiSquared(rows[0].data(), rows[0].data(), size), 0);
  }
}

TEST(ChiSquared, SinglePrecisionComesNearWhateverTheSize) {
  for (const std::size_t size : {1, 7, 8, 16, 31, 33, 352, 1344}) {
    const Rows rows = histograms(3, size, 3);
    const float *query = rows[0].data(), *first = rows[1].data(), *second = rows[2].data();
    float both[2];
    sks::chiSquaredOfTwo(query, first, second, size, both);
    for (const int i : {1, 2}) {
      const double exact = plainChiSquared(rows[0], rows[i]);
      EXPECT_NEAR(both[i - 1], exact, 1e-5 * exact) << size;
      EXPECT_NEAR(sks::chiSquaredFast(query, rows[i].data(), size), exact, 1e-5 * exact) << size;
    }
  }
}

class Matching : public testing::TestWithParam<std::size_t> {};

TEST_P(Matching, EqualsThePlainLoopOnRandomHistograms) {  // trap 11
  for (const std::size_t count : {17u, 400u}) {
    expectExact(histograms(count, GetParam(), 1), histograms(40, GetParam(), 2), GetParam());
  }
}

TEST_P(Matching, EqualsThePlainLoopOnNearDuplicates) {
  const std::size_t size = GetParam();
  std::mt19937 random(3);
  Rows words = histograms(20, size, 4);
  for (std::size_t i = 0; i < 300; ++i) {  // differ by a few roundings, or by a bit more
    std::vector<float> word = words[i % 20];
    for (float& bin : word) bin *= 1 + (i % 2 ? 1e-6f : 1e-3f) * (uniform(random) - 0.5f);
    words.push_back(word);
  }
  Rows queries(words.begin(), words.begin() + 20);
  for (std::size_t i = 0; i < 20; ++i) {
    std::vector<float> query = words[i];
    for (float& bin : query) bin = std::max(0.0f, bin + 0.01f * (uniform(random) - 0.5f));
    queries.push_back(query);
  }
  expectExact(words, queries, size);
}

TEST_P(Matching, OfEquallyNearWordsTheFirstWins) {
  Rows words = histograms(50, GetParam(), 6, 1.0);
  const Rows once = words;
  words.insert(words.end(), once.begin(), once.end());
  words.insert(words.end(), once.rbegin(), once.rend());
  const auto matches = sks::Matcher(matrix(words, GetParam())).match(matrix(once, GetParam()), 1);
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(matches[i].word, i);
    EXPECT_EQ(matches[i].distance, 0);
  }
  const Rows same(40, once[0]);
  for (const auto& match : sks::Matcher(matrix(same, GetParam())).match(matrix(once, GetParam()), 1)) {
    EXPECT_EQ(match.word, 0u);
  }
}

TEST_P(Matching, EqualsThePlainLoopOnZeroAndSparseHistograms) {
  const std::size_t size = GetParam();
  std::mt19937 random(8);
  Rows words = histograms(30, size, 9);
  for (const double filled : {0.01, 0.02, 1.0}) {
    for (int i = 0; i < 20; ++i) words.push_back(histogram(random, size, filled));
  }
  words.insert(words.begin() + 7, std::vector<float>(size, 0.0f));
  Rows queries = words;
  for (int i = 0; i < 10; ++i) queries.push_back(histogram(random, size, 0.01));
  std::vector<float> tiny(size, 0.0f);
  tiny[0] = 1e-20f;
  queries.push_back(tiny);
  expectExact(words, queries, size);
}

TEST_P(Matching, LowerBoundsNeverExceedTheDistanceAndOnlyGrow) {
  const std::size_t size = GetParam();
  std::vector<std::size_t> sizes;
  for (const std::size_t groups : {1u, 5u, 24u, 200u}) {
    if (groups <= size) sizes.push_back(groups);
  }
  const auto levels = sks::learnBoundCascade(matrix(histograms(100, size, 11), size), sizes);
  ASSERT_EQ(levels.size(), sizes.size());
  std::mt19937 random(12);
  for (int trial = 0; trial < 200; ++trial) {
    const auto a = histogram(random, size, 0.02 + 0.2 * (trial % 5)), b = histogram(random, size, 0.3);
    double previous = 0;
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const sks::BinMerge& level = levels[i];
      ASSERT_EQ(level.size, sizes[i]);
      ASSERT_EQ(level.group.size(), size);
      ASSERT_GE(level.padded(), level.size);
      std::vector<float> merged_a(level.padded(), 7.0f), merged_b(level.padded(), 7.0f);  // padding is overwritten
      level.apply(a.data(), merged_a.data());
      level.apply(b.data(), merged_b.data());
      const double bound = plainChiSquared(merged_a, merged_b);
      EXPECT_GE(bound, previous * (1 - 1e-6));
      previous = bound;
    }
    EXPECT_LE(previous, plainChiSquared(a, b) * (1 + 1e-6));
  }
}

TEST_P(Matching, DoesNotDependOnThreads) {  // trap 9
  const sks::Matcher matcher(matrix(histograms(300, GetParam(), 13), GetParam()));
  const sks::DescriptorMatrix queries = matrix(histograms(101, GetParam(), 14), GetParam());
  const auto one = matcher.match(queries, 1);
  for (const int threads : {2, 5}) {
    const auto more = matcher.match(queries, threads);
    ASSERT_EQ(more.size(), one.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(more[i].descriptor, one[i].descriptor);
      EXPECT_EQ(more[i].word, one[i].word);
      EXPECT_EQ(more[i].distance, one[i].distance);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Matching, testing::Values(7u, 33u, 352u, 1344u));

// Most colour bins of plainly coloured objects are empty: learning which bins to merge must not look at each of them
// for every merge. Merges start at one group for each filled bin, and one for all that are empty.
TEST(Matcher, EmptyBinsAreOneGroupBeforeTheFirstMerge) {
  Rows words = histograms(200, 1344, 20), queries = histograms(20, 1344, 21);
  for (auto& row : words) std::fill(row.begin() + 100, row.end(), 0.0f);
  const auto levels = sks::learnBoundCascade(matrix(words, 1344), {50, 1300});
  ASSERT_EQ(levels.size(), 2u);
  EXPECT_EQ(levels[0].size, 50u);
  EXPECT_LE(levels[1].size, 101u);
  for (std::size_t bin = 101; bin < 1344; ++bin) ASSERT_EQ(levels[1].group[bin], levels[1].group[100]) << bin;
  expectExact(words, queries, 1344);
}

TEST(Matcher, OfOneWordMatchesIt) {
  for (const std::size_t size : {1u, 33u, 352u}) expectExact(histograms(1, size, 18), histograms(3, size, 19), size);
}

TEST(Matcher, RefusesWhatIsNoHistogramNamingWordAndBin) {
  for (const auto& [value, text] : {std::make_pair(-0.5f, "-0.5"),
                                    {std::numeric_limits<float>::infinity(), "inf"},
                                    {1e27f, "99999"},
                                    {std::numeric_limits<float>::quiet_NaN(), "nan"}}) {
    Rows words = histograms(5, 33, 15);
    words[3][17] = value;
    const std::string message = sks::test::errorOf(sks::ErrorCode::bad_data, [&] { sks::Matcher{matrix(words, 33)}; });
    EXPECT_THAT(message, HasSubstr("codeword 3 is no histogram: bin 17 is "));
    EXPECT_THAT(message, HasSubstr(text));
  }
}

TEST(Matcher, RefusesDescriptorsOfAnotherSize) {
  const sks::Matcher matcher(matrix(histograms(5, 352, 16), 352));
  const sks::DescriptorMatrix queries = matrix(histograms(2, 1344, 17), 1344);
  EXPECT_EQ(sks::test::errorOf(sks::ErrorCode::incompatible, [&] { matcher.match(queries, 1); }),
            "descriptors of 1344 bins cannot be matched with codewords of 352");
}

TEST(Matcher, OfNothingMatchesNothing) {
  EXPECT_TRUE(sks::Matcher(matrix({}, 352)).match(matrix(histograms(2, 352, 1), 352), 1).empty());
  EXPECT_TRUE(sks::Matcher(matrix(histograms(2, 352, 1), 352)).match(matrix({}, 352), 1).empty());
}

class ApproximateMatching : public testing::Test {
protected:
  static constexpr std::size_t size = 352;

  /// Many words around few prototypes, as neighbouring views of a surface give.
  ApproximateMatching() {
    const Rows prototypes = histograms(200, size, 31);
    for (int i = 0; i < 6000; ++i) words.push_back(jittered(prototypes[i % prototypes.size()], 0.3f));
    for (int i = 0; i < 300; ++i) queries.push_back(jittered(words[17 * i], 0.1f));
  }

  std::vector<float> jittered(std::vector<float> bins, float share) {
    for (float& bin : bins) bin *= 1 + share * (2 * uniform(random) - 1);
    return bins;
  }

  std::mt19937 random{30};
  Rows words, queries;
};

TEST_F(ApproximateMatching, FindsNearlyAllNearestWords) {
  const auto exact = sks::Matcher(matrix(words, size), sks::SearchKind::exact).match(matrix(queries, size), 2);
  const auto found = sks::Matcher(matrix(words, size), sks::SearchKind::approximate).match(matrix(queries, size), 2);
  ASSERT_EQ(found.size(), exact.size());
  std::size_t equal = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    equal += found[i].word == exact[i].word;
    EXPECT_EQ(found[i].descriptor, i);
    EXPECT_GE(found[i].distance, exact[i].distance);
    EXPECT_FLOAT_EQ(found[i].distance, float(plainChiSquared(queries[i], words[found[i].word])));
  }
  EXPECT_GE(double(equal), 0.97 * double(exact.size()));
}

TEST_F(ApproximateMatching, DependsNeitherOnThreadsNorOnOtherQueries) {
  const sks::Matcher matcher(matrix(words, size), sks::SearchKind::approximate);
  const sks::Matcher again(matrix(words, size), sks::SearchKind::approximate);
  const auto together = matcher.match(matrix(queries, size), 1);
  for (const int threads : {2, 5}) {
    const auto more = again.match(matrix(queries, size), threads);
    for (std::size_t i = 0; i < together.size(); ++i) {
      ASSERT_EQ(more[i].word, together[i].word);
      ASSERT_EQ(more[i].distance, together[i].distance);
    }
  }
  for (const std::size_t i : {0u, 7u, 299u}) {
    const auto alone = matcher.match(matrix({queries[i]}, size), 2);
    EXPECT_EQ(alone[0].word, together[i].word);
    EXPECT_EQ(alone[0].distance, together[i].distance);
  }
}

TEST_F(ApproximateMatching, OfFewOrEqualWordsIsExact) {
  for (const std::size_t count : {1u, 2u, 300u, 600u}) {
    const Rows same(count, words[0]);
    for (const auto& match :
         sks::Matcher(matrix(same, size), sks::SearchKind::approximate).match(matrix(queries, size), 2)) {
      ASSERT_EQ(match.word, 0u);
    }
  }
  EXPECT_TRUE(sks::Matcher(matrix({}, size), sks::SearchKind::approximate).match(matrix(queries, size), 2).empty());
}
