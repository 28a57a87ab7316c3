// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/stages/quantized_descriptors.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include <sks_detector/stages/matching.hpp>

#include "core/descriptors/quantizer.hpp"
#include "error_of.hpp"
#include "histograms.hpp"

namespace sks {
namespace {

using test::histograms;
using test::matrix;
using ::testing::HasSubstr;

TEST(QuantizedDescriptors, RootsAreOffByHalfALevelAtMost) {
  for (const std::size_t size : {1u, 7u, 33u, 352u, 1344u}) {
    const DescriptorMatrix rows = matrix(histograms(5, size, 3), size);
    const QuantizedDescriptors rounded(rows);
    ASSERT_EQ(rounded.rows(), 5u);
    ASSERT_EQ(rounded.cols(), size);
    const DescriptorMatrix back = rounded.values();
    for (std::size_t row = 0; row < rows.rows(); ++row) {
      const float largest = *std::max_element(rows.row(row), rows.row(row) + size);
      for (std::size_t bin = 0; bin < size; ++bin) {
        const float level = std::sqrt(largest) / 255;
        EXPECT_NEAR(std::sqrt(back.row(row)[bin]), std::sqrt(rows.row(row)[bin]), 0.501f * level);
        EXPECT_EQ(back.row(row)[bin] == 0, rounded.levels(row)[bin] == 0);
      }
      EXPECT_FLOAT_EQ(*std::max_element(back.row(row), back.row(row) + size), largest);
    }
  }
}

TEST(QuantizedDescriptors, DistancesHardlyChange) {
  const DescriptorMatrix rows = matrix(histograms(40, 352, 5), 352), back = QuantizedDescriptors(rows).values();
  for (std::size_t row = 0; row < rows.rows(); ++row) {
    EXPECT_LT(chiSquared(rows.row(row), back.row(row), 352), 1e-3);
  }
}

TEST(QuantizedDescriptors, OfZerosAreZeros) {
  const QuantizedDescriptors rounded(DescriptorMatrix(std::vector<float>(2 * 33, 0.0f), 33));
  EXPECT_EQ(rounded.scale(1), 0);
  std::vector<float> bins(33, 1.0f);
  rounded.read(1, bins.data());
  EXPECT_EQ(bins, std::vector<float>(33, 0.0f));
}

TEST(QuantizedDescriptors, RefuseWhatIsNoHistogram) {
  for (const float value : {-0.5f, 1e5f, std::numeric_limits<float>::quiet_NaN()}) {
    std::vector<float> bins(2 * 33, 0.1f);
    bins[33 + 17] = value;
    EXPECT_THAT(test::errorOf(ErrorCode::bad_data, [&] { QuantizedDescriptors{DescriptorMatrix(bins, 33)}; }),
                HasSubstr("descriptor 1 is no histogram: bin 17 is "));
  }
}

TEST(Quantizer, TakesOverRowsAsTheyAre) {
  const QuantizedDescriptors rounded(matrix(histograms(4, 352, 7), 352));
  Quantizer quantizer(352);
  quantizer.add(rounded, 3);
  quantizer.add(rounded, 1);
  const QuantizedDescriptors some = quantizer.release();
  ASSERT_EQ(some.rows(), 2u);
  EXPECT_EQ(some.scale(0), rounded.scale(3));
  EXPECT_TRUE(std::equal(some.levels(0), some.levels(0) + 352, rounded.levels(3)));
  EXPECT_TRUE(std::equal(some.levels(1), some.levels(1) + 352, rounded.levels(1)));
  EXPECT_EQ(quantizer.release().rows(), 0u);
}

/// Rounded words are searched as if their values were given.
TEST(QuantizedDescriptors, AreMatchedLikeTheirValues) {
  const QuantizedDescriptors words(matrix(histograms(700, 352, 11), 352));
  const DescriptorMatrix queries = matrix(histograms(60, 352, 12), 352);
  for (const SearchKind search : {SearchKind::exact, SearchKind::approximate}) {
    const auto rounded = Matcher(words, search).match(queries, 2),
               values = Matcher(words.values(), search).match(queries, 2);
    ASSERT_EQ(rounded.size(), values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      EXPECT_EQ(rounded[i].word, values[i].word);
      EXPECT_EQ(rounded[i].distance, values[i].distance);
    }
  }
}

}  // namespace
}  // namespace sks
