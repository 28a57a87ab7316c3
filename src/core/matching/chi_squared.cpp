// SPDX-License-Identifier: BSD-3-Clause
#include "core/matching/chi_squared.hpp"

#include <hwy/cache_control.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/matching/chi_squared.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "core/descriptors/compressor-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace sks {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr float smallest_sum = 1e-30f;  // keeps 0 / 0 out; the numerator is 0 then

/// (a-b)^2 / (a+b). The approximate reciprocal and one Newton step take less time than a division.
template <class D, class V>
HWY_INLINE V term(D d, V a, V b) {
  const auto difference = hn::Sub(a, b), both = hn::Max(hn::Add(a, b), hn::Set(d, smallest_sum));
  const auto guess = hn::ApproximateReciprocal(both);
  const auto reciprocal = hn::Mul(guess, hn::NegMulAdd(guess, both, hn::Set(d, 2.0f)));
  return hn::Mul(hn::Mul(difference, difference), reciprocal);
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
    const auto low = hn::Le(hn::LoadU(d, values + i), highest);
    if (hn::AllFalse(d, low)) continue;
    const Compressor<decltype(d)> compress(d, low);
    hn::StoreU(compress(hn::Iota(du, std::uint32_t(i))), du, indices + selected);
    selected += compress.count();
  }
  for (; i < count; ++i) {
    if (values[i] <= limit) indices[selected++] = std::uint32_t(i);
  }
  return selected;
}

/// Terms of the bins from `begin` on, one at a time.
HWY_INLINE float sumOfRest(const float* a, const float* b, std::size_t begin, std::size_t size) {
  float total = 0;
  for (std::size_t i = begin; i < size; ++i) {
    const float difference = a[i] - b[i], both = a[i] + b[i];
    if (both > 0) total += difference * difference / both;
  }
  return total;
}

float chiSquaredFastImpl(const float* a, const float* b, std::size_t size) {
  const hn::ScalableTag<float> d;
  const std::size_t lanes = hn::Lanes(d);
  const auto at = [&](std::size_t i) { return term(d, hn::LoadU(d, a + i), hn::LoadU(d, b + i)); };
  auto sum0 = hn::Zero(d), sum1 = sum0, sum2 = sum0, sum3 = sum0;
  std::size_t i = 0;
  for (; i + 4 * lanes <= size; i += 4 * lanes) {
    sum0 = hn::Add(sum0, at(i));
    sum1 = hn::Add(sum1, at(i + lanes));
    sum2 = hn::Add(sum2, at(i + 2 * lanes));
    sum3 = hn::Add(sum3, at(i + 3 * lanes));
  }
  for (; i + lanes <= size; i += lanes) sum0 = hn::Add(sum0, at(i));
  const auto sum = hn::Add(hn::Add(sum0, sum1), hn::Add(sum2, sum3));
  return hn::GetLane(hn::SumOfLanes(d, sum)) + sumOfRest(a, b, i, size);
}

void chiSquaredOfTwoImpl(const float* query, const float* first, const float* second, std::size_t size,
                         float* distances) {
  const hn::ScalableTag<float> d;
  const std::size_t lanes = hn::Lanes(d);
  auto sum0 = hn::Zero(d), sum1 = sum0, sum2 = sum0, sum3 = sum0;
  std::size_t i = 0;
  for (; i + 2 * lanes <= size; i += 2 * lanes) {
    const auto q0 = hn::LoadU(d, query + i), q1 = hn::LoadU(d, query + i + lanes);
    sum0 = hn::Add(sum0, term(d, q0, hn::LoadU(d, first + i)));
    sum1 = hn::Add(sum1, term(d, q0, hn::LoadU(d, second + i)));
    sum2 = hn::Add(sum2, term(d, q1, hn::LoadU(d, first + i + lanes)));
    sum3 = hn::Add(sum3, term(d, q1, hn::LoadU(d, second + i + lanes)));
  }
  distances[0] = hn::GetLane(hn::SumOfLanes(d, hn::Add(sum0, sum2))) + sumOfRest(query, first, i, size);
  distances[1] = hn::GetLane(hn::SumOfLanes(d, hn::Add(sum1, sum3))) + sumOfRest(query, second, i, size);
}

void chiSquaredRowsImpl(const float* query, std::size_t bins, const std::uint16_t* table, const std::uint32_t* rows,
                        std::size_t count, float* distances) {
  const hn::CappedTag<float, row_multiple> d;
  const hn::Rebind<std::uint32_t, decltype(d)> d_whole;
  const hn::Rebind<std::uint16_t, decltype(d)> d_half;
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t i = 0; i < count; ++i) {
    if (i + 4 < count) {
      for (std::size_t bin = 0; bin < bins; bin += 32) hwy::Prefetch(table + rows[i + 4] * bins + bin);
    }
    const std::uint16_t* row = table + rows[i] * bins;
    auto sum = hn::Zero(d);
    for (std::size_t bin = 0; bin < bins; bin += lanes) {
      const auto values = hn::ShiftLeft<16>(hn::PromoteTo(d_whole, hn::LoadU(d_half, row + bin)));
      sum = hn::Add(sum, term(d, hn::LoadU(d, query + bin), hn::BitCast(d, values)));
    }
    distances[i] = hn::GetLane(hn::SumOfLanes(d, sum));
  }
}

float mergingCostImpl(const PairTerms& p, const PairTerms& q, std::size_t count) {
  const hn::CappedTag<float, row_multiple> d;
  auto sum = hn::Zero(d);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto apart = hn::Add(hn::LoadU(d, p.terms + i), hn::LoadU(d, q.terms + i));
    const auto a = hn::Add(hn::LoadU(d, p.a + i), hn::LoadU(d, q.a + i));
    const auto b = hn::Add(hn::LoadU(d, p.b + i), hn::LoadU(d, q.b + i));
    sum = hn::Add(sum, hn::Sub(apart, term(d, a, b)));
  }
  return hn::GetLane(hn::SumOfLanes(d, sum));
}

}  // namespace HWY_NAMESPACE
}  // namespace sks
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sks {

HWY_EXPORT(indexOfSmallestImpl);
HWY_EXPORT(selectUpToImpl);
HWY_EXPORT(chiSquaredFastImpl);
HWY_EXPORT(chiSquaredOfTwoImpl);
HWY_EXPORT(chiSquaredRowsImpl);
HWY_EXPORT(mergingCostImpl);

std::size_t indexOfSmallest(const float* values, std::size_t count) {
  return HWY_DYNAMIC_DISPATCH(indexOfSmallestImpl)(values, count);
}

std::size_t selectUpTo(float limit, const float* values, std::size_t count, std::uint32_t* indices) {
  return HWY_DYNAMIC_DISPATCH(selectUpToImpl)(limit, values, count, indices);
}

float chiSquaredFast(const float* a, const float* b, std::size_t size) {
  return HWY_DYNAMIC_DISPATCH(chiSquaredFastImpl)(a, b, size);
}

void chiSquaredOfTwo(const float* query, const float* first, const float* second, std::size_t size, float* distances) {
  HWY_DYNAMIC_DISPATCH(chiSquaredOfTwoImpl)(query, first, second, size, distances);
}

void chiSquaredRows(const float* query, std::size_t bins, const std::uint16_t* table, const std::uint32_t* rows,
                    std::size_t count, float* distances) {
  HWY_DYNAMIC_DISPATCH(chiSquaredRowsImpl)(query, bins, table, rows, count, distances);
}

float mergingCost(const PairTerms& p, const PairTerms& q, std::size_t count) {
  return HWY_DYNAMIC_DISPATCH(mergingCostImpl)(p, q, count);
}

}  // namespace sks
#endif
