// SPDX-License-Identifier: BSD-3-Clause
#include "peak.hpp"

#include <algorithm>

#include "pair.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "benchmark/peak.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sks {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Ten chains of multiply-adds, enough to fill the pipelines. @return the number of operations
double multiplyAdds(std::size_t rounds, float* result) {
  const hn::ScalableTag<float> d;
  const auto factor = hn::Set(d, 0.999f), term = hn::Set(d, 0.001f);
  auto a = term, b = a, c = a, e = a, f = a, g = a, h = a, i = a, j = a, k = a;
  for (std::size_t round = 0; round < rounds; ++round) {
    for (auto* chain : {&a, &b, &c, &e, &f, &g, &h, &i, &j, &k}) *chain = hn::MulAdd(*chain, factor, term);
  }
  auto sum = a;
  for (const auto& chain : {b, c, e, f, g, h, i, j, k}) sum = hn::Add(sum, chain);
  *result = hn::GetLane(hn::SumOfLanes(d, sum));
  return 2.0 * 10 * double(hn::Lanes(d)) * double(rounds);
}

}  // namespace HWY_NAMESPACE
}  // namespace sks
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sks {

HWY_EXPORT(multiplyAdds);

namespace bench {

double peakOperationsPerSecond() {
  double best = 0;
  for (int i = 0; i < 9; ++i) {
    double operations = 0;
    float result = 0;
    const double time = milliseconds([&] { operations = HWY_DYNAMIC_DISPATCH(multiplyAdds)(2000000, &result); });
    benchmark::DoNotOptimize(result);
    best = std::max(best, operations / time * 1000);
  }
  return best;
}

}  // namespace bench
}  // namespace sks
#endif
