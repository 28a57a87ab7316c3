// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace sks {

/// Index of the (first) smallest of `count` > 0 values.
std::size_t indexOfSmallest(const float* values, std::size_t count);

/// What selectUpTo() may write beyond the last index.
constexpr std::size_t selection_room = 64;

/// Writes the indices of the values that are not above `limit`, ascending, and returns how many; `indices` must have
/// room for `count` + selection_room.
std::size_t selectUpTo(float limit, const float* values, std::size_t count, std::uint32_t* indices);

/// Chi squared distance in single precision (relative error below 1e-5). SIMD, runtime dispatch.
float chiSquaredFast(const float* a, const float* b, std::size_t size);

/// The same of one query to two words, in less time than one after the other.
void chiSquaredOfTwo(const float* query, const float* first, const float* second, std::size_t size, float* distances);

/// Of this many numbers the sizes of the following must be multiples; zeros in both histograms add nothing.
constexpr std::size_t row_multiple = 16;

/// Chi squared distances of one query to chosen rows of a table of bfloat16 numbers (the upper halves of floats):
/// `distances[i]` belongs to row `rows[i]`.
void chiSquaredRows(const float* query, std::size_t bins, const std::uint16_t* table, const std::uint32_t* rows,
                    std::size_t count, float* distances);

/// One bin of pairs of histograms.
struct PairTerms {
  const float *a, *b;  ///< values
  const float* terms;  ///< (a-b)^2 / (a+b)
};

/// What `count` pairs together lose of their distance if two bins are merged.
float mergingCost(const PairTerms& p, const PairTerms& q, std::size_t count);

}  // namespace sks
