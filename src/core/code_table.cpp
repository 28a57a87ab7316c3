// SPDX-License-Identifier: BSD-3-Clause
#include "core/code_table.hpp"

#include <cstring>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/code_table.cpp"
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

void codeDistancesImpl(const std::array<const CodedVector*, queries_at_once>& queries, const CodeTable& table,
                       std::size_t first_block, std::size_t blocks,
                       const std::array<float*, queries_at_once>& distances) {
  static_assert(queries_at_once == 4, "the loop below is unrolled by hand");
  const Sums d;
  const hn::RebindToFloat<Sums> df;
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t first = 0; first < blocks * block_words; first += lanes) {
    const std::size_t block = first_block + first / block_words, word = first_block * block_words + first;
    const std::int16_t* column = &table.codes[block * block_size + 2 * (first % block_words)];
    Sum sum0 = hn::Zero(d), sum1 = sum0, sum2 = sum0, sum3 = sum0;
    for (std::size_t i = 0; i < code_size; i += 2, column += 2 * block_words) {
      const Pairs words = loadPairs(column);
      sum0 = addProducts(words, repeatPair(&queries[0]->code[i]), sum0);
      sum1 = addProducts(words, repeatPair(&queries[1]->code[i]), sum1);
      sum2 = addProducts(words, repeatPair(&queries[2]->code[i]), sum2);
      sum3 = addProducts(words, repeatPair(&queries[3]->code[i]), sum3);
    }
    const auto store = [&](std::size_t q, Sum sum) {
      const auto squares = hn::Add(hn::Set(df, queries[q]->squares), hn::LoadU(df, &table.squares[word]));
      const auto units = hn::Mul(hn::Set(df, 2 * queries[q]->unit), hn::LoadU(df, &table.units[word]));
      hn::StoreU(hn::NegMulAdd(units, hn::ConvertTo(df, sum), squares), df, distances[q] + first);
    };
    store(0, sum0);
    store(1, sum1);
    store(2, sum2);
    store(3, sum3);
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
