// SPDX-License-Identifier: BSD-3-Clause
// How near the chi squared kernel comes to what a core can do: the same arithmetic on registers alone.
#include "core/matching/chi_squared.hpp"
#include "pair.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "../benchmark/chi_squared_benchmark.cpp"  // from src
#include <hwy/foreach_target.h>

#include <hwy/aligned_allocator.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sks {
namespace bench {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Adds up `count` terms of chi squared, with nothing to load: eight sums hide every latency.
float termsOnRegistersImpl(std::size_t count) {
  const hn::ScalableTag<float> d;
  const auto two = hn::Set(d, 2.0f), tiny = hn::Set(d, 1e-30f);
  constexpr std::size_t sums = 8;
  auto b = hn::Set(d, 0.3f);
  auto s0 = hn::Iota(d, 1.0f), s1 = s0, s2 = s0, s3 = s0, s4 = s0, s5 = s0, s6 = s0, s7 = s0;
  const auto add = [&](auto& sum) {
    // The sum stands for the loaded value, so that no term can be left out.
    const auto difference = hn::Sub(sum, b), both = hn::Max(hn::Add(sum, b), tiny);
    const auto guess = hn::ApproximateReciprocal(both);
    const auto reciprocal = hn::Mul(guess, hn::NegMulAdd(guess, both, two));
    sum = hn::Add(sum, hn::Mul(hn::Mul(difference, difference), reciprocal));
  };
  for (std::size_t i = 0; i < count; i += sums * hn::Lanes(d)) {
    add(s0);
    add(s1);
    add(s2);
    add(s3);
    add(s4);
    add(s5);
    add(s6);
    add(s7);
  }
  const auto all = hn::Add(hn::Add(hn::Add(s0, s1), hn::Add(s2, s3)), hn::Add(hn::Add(s4, s5), hn::Add(s6, s7)));
  return hn::GetLane(hn::SumOfLanes(d, all));
}

}  // namespace HWY_NAMESPACE
}  // namespace bench
}  // namespace sks
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sks::bench {
namespace {

HWY_EXPORT(termsOnRegistersImpl);

constexpr std::size_t bins = 352, rows = 16, repetitions = 4000;  // rows and query lie in the first cache

/// Ratio: the kernel's share of the limit. 8 vector instructions and 8 bytes for each term.
void chiSquaredKernel(benchmark::State& state) {
  const auto values = hwy::AllocateAligned<float>((rows + 1) * bins);  // like the rows of a codebook file
  for (std::size_t i = 0; i < (rows + 1) * bins; ++i) values[i] = float(i * 2654435761u % 1000) / 1000.0f;
  float sum = 0;
  compare(
      state, [&] { benchmark::DoNotOptimize(HWY_DYNAMIC_DISPATCH(termsOnRegistersImpl)(repetitions * rows * bins)); },
      [&] {
        for (std::size_t i = 0; i < repetitions; ++i) {
          for (std::size_t row = 1; row <= rows; row += 2) {
            float distances[2];
            chiSquaredOfTwo(values.get(), &values[row * bins], &values[(row + 1) * bins], bins, distances);
            sum += distances[0] + distances[1];
          }
        }
        benchmark::DoNotOptimize(sum);
      },
      0.5, 41);
  state.SetLabel("ratio is the share of the core's peak");
  state.counters["terms_per_ns"] = double(repetitions * rows * bins) / (1e6 * state.counters["ours_ms"]);
}
BENCHMARK(chiSquaredKernel)->Apply(asPair);

}  // namespace
}  // namespace sks::bench
#endif
