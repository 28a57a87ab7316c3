// SPDX-License-Identifier: BSD-3-Clause
#include "core/matching/lowest_bounds.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

namespace sks {
namespace {

// Steps are numbers in single precision without all but five bits of their fractions: 32 of each power of two, of which
// there are 16, up to 16 times what is usual.
constexpr int dropped_bits = 18;
constexpr std::uint32_t lowest_step = (127 - 12) << 5;  // of 2^-12

}  // namespace

void LowestBounds::begin(std::size_t wanted, float unit) {
  slots.clear();
  bounds.clear();
  wanted_ = wanted;
  scale_ = 1 / unit;
  highest_ = std::numeric_limits<float>::infinity();
  count_.fill(0);
  last_ = steps - 1;
  within_ = 0;
}

std::size_t LowestBounds::stepOf(float bound) const {
  const float relative = std::max(bound * scale_, 0.0f);
  std::uint32_t bits = 0;
  std::memcpy(&bits, &relative, sizeof bits);
  const std::uint32_t step = bits >> dropped_bits;
  return step < lowest_step ? 0 : std::min<std::size_t>(step - lowest_step, steps - 1);
}

void LowestBounds::add(std::uint32_t first, const float* of_slots, const std::uint32_t* selected, std::size_t count) {
  const std::size_t before = slots.size();
  slots.resize(before + count);
  bounds.resize(before + count);
  for (std::size_t i = 0; i < count; ++i) {
    slots[before + i] = first + selected[i];
    bounds[before + i] = of_slots[selected[i]];
  }
  if (wanted_ == 0) return;
  for (std::size_t i = before; i < bounds.size(); ++i) {
    const std::size_t step = stepOf(bounds[i]);
    ++count_[step];
    within_ += step <= last_;
  }
  lower();
}

void LowestBounds::lower() {
  const std::size_t before = last_;
  while (last_ > 0 && within_ - count_[last_] >= wanted_) within_ -= count_[last_--];
  if (last_ == before) return;
  const std::uint32_t bits = (lowest_step + std::uint32_t(last_) + 1) << dropped_bits;
  float relative = 0;
  std::memcpy(&relative, &bits, sizeof relative);
  highest_ = relative / scale_;
}

void LowestBounds::keepUpTo(float bound) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    slots[kept] = slots[i];
    bounds[kept] = bounds[i];
    kept += bounds[i] <= bound;
  }
  slots.resize(kept);
  bounds.resize(kept);
}

}  // namespace sks
