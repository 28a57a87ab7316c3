// SPDX-License-Identifier: BSD-3-Clause
#include "core/matching/code_table.hpp"

#include <cstring>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/matching/code_table.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sks {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Sums = hn::CappedTag<std::int32_t, block_words>;
using Sum = hn::Vec<Sums>;

#if HWY_TARGET == HWY_SCALAR
using Pairs = std::array<std::int32_t, 2>;

HWY_INLINE Pairs loadPairs(const std::int16_t* from) {
  return {from[0], from[1]};
}

HWY_INLINE Pairs repeatPair(const std::int16_t* from) {
  return loadPairs(from);
}

HWY_INLINE Sum addProducts(Pairs a, Pairs b, Sum sum) {
  return hn::Add(sum, hn::Set(Sums(), a[0] * b[0] + a[1] * b[1]));
}
#else
using PairsTag = hn::Repartition<std::int16_t, Sums>;
using Pairs = hn::Vec<PairsTag>;

HWY_INLINE Pairs loadPairs(const std::int16_t* from) {
  return hn::LoadU(PairsTag(), from);
}

HWY_INLINE Pairs repeatPair(const std::int16_t* from) {
  std::int32_t pair = 0;
  std::memcpy(&pair, from, sizeof pair);
  return hn::BitCast(PairsTag(), hn::Set(Sums(), pair));
}

/// Adds the products of both numbers of each pair to its sum, exactly.
HWY_INLINE Sum addProducts(Pairs a, Pairs b, Sum sum) {
  Sum odd = hn::Zero(Sums());
  sum = hn::ReorderWidenMulAccumulate(Sums(), a, b, sum, odd);
  return hn::RearrangeToOddPlusEven(sum, odd);
}
#endif

/// Inner products of `vectors` vectors of words, the first in `column`, with four queries.
template <std::size_t vectors>
HWY_INLINE void innerProducts(const std::array<const CodedVector*, queries_at_once>& queries,
                              const std::int16_t* column, Sum (&sums)[vectors][queries_at_once]) {
  const Sums d;
  for (auto& of_vector : sums) {
    for (Sum& sum : of_vector) sum = hn::Zero(d);
  }
  for (std::size_t i = 0; i < code_size; i += 2, column += 2 * block_words) {
    for (std::size_t v = 0; v < vectors; ++v) {
      const Pairs words = loadPairs(column + 2 * v * hn::Lanes(d));
      for (std::size_t q = 0; q < queries_at_once; ++q) {
        sums[v][q] = addProducts(words, repeatPair(&queries[q]->code[i]), sums[v][q]);
      }
    }
  }
}

void codeDistancesImpl(const std::array<const CodedVector*, queries_at_once>& queries, const CodeTable& table,
                       std::size_t first_block, std::size_t blocks,
                       const std::array<float*, queries_at_once>& distances) {
  const Sums d;
  const hn::RebindToFloat<Sums> df;
  // Short vectors are taken in pairs: what is loaded of the queries then serves both.
  constexpr std::size_t vectors = 2 * block_words >= HWY_MAX_BYTES ? 2 : 1;
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t first = 0; first < blocks * block_words; first += vectors * lanes) {
    const std::size_t block = first_block + first / block_words;
    Sum sums[vectors][queries_at_once];
    innerProducts(queries, &table.codes[block * block_size + 2 * (first % block_words)], sums);
    for (std::size_t v = 0; v < vectors; ++v) {
      const std::size_t at = first + v * lanes, word = first_block * block_words + at;
      const auto of_words = hn::LoadU(df, &table.squares[word]), units = hn::LoadU(df, &table.units[word]);
      for (std::size_t q = 0; q < queries_at_once; ++q) {
        const auto squares = hn::Add(hn::Set(df, queries[q]->squares), of_words);
        const auto both = hn::Mul(hn::Set(df, 2 * queries[q]->unit), units);
        hn::StoreU(hn::NegMulAdd(both, hn::ConvertTo(df, sums[v][q]), squares), df, distances[q] + at);
      }
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace sks
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sks {

CodeTable::CodeTable(std::size_t words)
    : codes((words + block_words - 1) / block_words * block_size),
      units(codes.size() / code_size),
      squares(units.size(), std::numeric_limits<float>::infinity()) {}

void CodeTable::set(std::size_t word, const CodedVector& vector) {
  std::int16_t* column = &codes[word / block_words * block_size + 2 * (word % block_words)];
  for (std::size_t i = 0; i < code_size; ++i) column[i / 2 * 2 * block_words + i % 2] = vector.code[i];
  units[word] = vector.unit;
  squares[word] = vector.squares;
}

HWY_EXPORT(codeDistancesImpl);

void codeDistances(const std::array<const CodedVector*, queries_at_once>& queries, const CodeTable& table,
                   std::size_t first_block, std::size_t blocks, const std::array<float*, queries_at_once>& distances) {
  HWY_DYNAMIC_DISPATCH(codeDistancesImpl)(queries, table, first_block, blocks, distances);
}

}  // namespace sks
#endif
