// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sks {

/// Collects words with bounds of their distances, and soon knows a bound above which none is among the lowest ones: how
/// many there are so far is counted in steps of 3 % of the bounds.
class LowestBounds {
public:
  /// Begins anew.
  /// @param wanted how many of the lowest are wanted; 0: all
  /// @param unit a usual bound
  void begin(std::size_t wanted, float unit);

  /// What is above it is not wanted.
  float highest() const { return highest_; }

  /// Adds slots with bounds up to highest().
  /// @param selected positions in `bounds`, which begin at slot `first`
  void add(std::uint32_t first, const float* bounds, const std::uint32_t* selected, std::size_t count);

  /// Drops what is above highest(): a few more than the wanted ones are left.
  void finish() { keepUpTo(highest_); }

  /// Drops what is above a bound.
  void keepUpTo(float bound);

  std::vector<std::uint32_t> slots;
  std::vector<float> bounds;

private:
  static constexpr std::size_t steps = 512;

  std::size_t stepOf(float bound) const;
  void lower();

  std::size_t wanted_ = 0;
  float scale_ = 1;  // of bounds, so that a usual one is 1
  float highest_ = 0;
  std::array<std::uint32_t, steps> count_{};  // of bounds of each step
  std::size_t last_ = 0;                      // step that may hold wanted ones
  std::size_t within_ = 0;                    // up to the last step
};

}  // namespace sks
