// SPDX-License-Identifier: BSD-3-Clause
#include "core/chi_squared.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/chi_squared.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sks {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr float smallest_sum = 1e-30f;  // keeps 0 / 0 out; the numerator is 0 then
constexpr float below_truth = 0.9995f;  // outweighs the error of the approximate reciprocal, 2^-11 at most

/// (a-b)^2 / (a+b) added to `sum`, with the approximate reciprocal.
template <class V>
HWY_INLINE V addTerm(V a, V b, V tiny, V sum) {
  const auto difference = hn::Sub(a, b);
  const auto reciprocal = hn::ApproximateReciprocal(hn::Max(hn::Add(a, b), tiny));
  return hn::MulAdd(hn::Mul(difference, difference), reciprocal, sum);
}

void chiSquaredBlocksImpl(const float* query, std::size_t bins, const float* table, std::size_t blocks,
                          float* distances) {
  const hn::CappedTag<float, block_words> d;
  const std::size_t lanes = hn::Lanes(d);
  const auto tiny = hn::Set(d, smallest_sum);
  const auto below = hn::Set(d, below_truth);
  for (std::size_t block = 0; block < blocks; ++block) {
    for (std::size_t part = 0; part < block_words; part += lanes) {
      const float* column = table + block * bins * block_words + part;
      auto sum = hn::Zero(d);
      for (std::size_t bin = 0; bin < bins; ++bin, column += block_words) {
        sum = addTerm(hn::Set(d, query[bin]), hn::LoadU(d, column), tiny, sum);
      }
      hn::StoreU(hn::Mul(sum, below), d, distances + block * block_words + part);
    }
  }
}

void chiSquaredRowsImpl(const float* query, std::size_t bins, const float* table, const std::uint32_t* rows,
                        std::size_t count, float* distances) {
  const hn::CappedTag<float, block_words> d;
  const std::size_t lanes = hn::Lanes(d);
  const auto tiny = hn::Set(d, smallest_sum);
  for (std::size_t i = 0; i < count; ++i) {
    const float* row = table + rows[i] * bins;
    auto sum = hn::Zero(d);
    for (std::size_t bin = 0; bin < bins; bin += lanes) {
      sum = addTerm(hn::LoadU(d, query + bin), hn::LoadU(d, row + bin), tiny, sum);
    }
    distances[i] = below_truth * hn::GetLane(hn::SumOfLanes(d, sum));
  }
}

std::size_t indexOfSmallestImpl(const float* values, std::size_t count) {
  const hn::ScalableTag<float> d;
  const std::size_t lanes = hn::Lanes(d);
  float smallest = values[0];
  if (count >= lanes) {
    auto low = hn::LoadU(d, values);
    for (std::size_t i = lanes; i + lanes <= count; i += lanes) low = hn::Min(low, hn::LoadU(d, values + i));
    smallest = hn::GetLane(hn::MinOfLanes(d, low));
  }
  for (std::size_t i = count - count % lanes; i < count; ++i) smallest = values[i] < smallest ? values[i] : smallest;
  std::size_t i = 0;
  const auto wanted = hn::Set(d, smallest);
  while (i + lanes <= count && hn::AllFalse(d, hn::Eq(hn::LoadU(d, values + i), wanted))) i += lanes;
  while (i + 1 < count && values[i] != smallest) ++i;
  return i;
}

std::size_t selectUpToImpl(float limit, const float* values, std::size_t count, std::uint32_t* indices) {
  const hn::ScalableTag<float> d;
  const hn::RebindToUnsigned<decltype(d)> du;
  const std::size_t lanes = hn::Lanes(d);
  const auto highest = hn::Set(d, limit);
  std::size_t selected = 0, i = 0;
  for (; i + lanes <= count; i += lanes) {
    const auto low = hn::RebindMask(du, hn::Le(hn::LoadU(d, values + i), highest));
    selected += hn::CompressStore(hn::Iota(du, std::uint32_t(i)), low, du, indices + selected);
  }
  for (; i < count; ++i) {
    if (values[i] <= limit) indices[selected++] = std::uint32_t(i);
  }
  return selected;
}

float chiSquaredFastImpl(const float* a, const float* b, std::size_t size) {
  const hn::ScalableTag<float> d;
  const std::size_t lanes = hn::Lanes(d);
  const auto tiny = hn::Set(d, smallest_sum);
  const auto term = [&](auto x, auto y) {
    const auto difference = hn::Sub(x, y);
    return hn::Div(hn::Mul(difference, difference), hn::Max(hn::Add(x, y), tiny));
  };
  auto sum = hn::Zero(d);
  std::size_t i = 0;
  for (; i + lanes <= size; i += lanes) sum = hn::Add(sum, term(hn::LoadU(d, a + i), hn::LoadU(d, b + i)));
  float total = hn::GetLane(hn::SumOfLanes(d, sum));
  for (; i < size; ++i) {
    const float difference = a[i] - b[i], both = a[i] + b[i];
    if (both > 0) total += difference * difference / both;
  }
  return total;
}

}  // namespace HWY_NAMESPACE
}  // namespace sks
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sks {

HWY_EXPORT(chiSquaredBlocksImpl);
HWY_EXPORT(chiSquaredRowsImpl);
HWY_EXPORT(indexOfSmallestImpl);
HWY_EXPORT(selectUpToImpl);
HWY_EXPORT(chiSquaredFastImpl);

void chiSquaredBlocks(const float* query, std::size_t bins, const float* table, std::size_t blocks, float* distances) {
  HWY_DYNAMIC_DISPATCH(chiSquaredBlocksImpl)(query, bins, table, blocks, distances);
}

void chiSquaredRows(const float* query, std::size_t bins, const float* table, const std::uint32_t* rows,
                    std::size_t count, float* distances) {
  HWY_DYNAMIC_DISPATCH(chiSquaredRowsImpl)(query, bins, table, rows, count, distances);
}

std::size_t indexOfSmallest(const float* values, std::size_t count) {
  return HWY_DYNAMIC_DISPATCH(indexOfSmallestImpl)(values, count);
}

std::size_t selectUpTo(float limit, const float* values, std::size_t count, std::uint32_t* indices) {
  return HWY_DYNAMIC_DISPATCH(selectUpToImpl)(limit, values, count, indices);
}

float chiSquaredFast(const float* a, const float* b, std::size_t size) {
  return HWY_DYNAMIC_DISPATCH(chiSquaredFastImpl)(a, b, size);
}

}  // namespace sks
#endif
