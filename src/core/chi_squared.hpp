// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace sks {

/// Words that stand side by side in one block of a table of bounds.
constexpr std::size_t block_words = 16;

/// Chi squared distances, a little below the true ones (by at most one in a thousand), of one query to every word of
/// `blocks` blocks laid out as [block][bin][word in block]. SIMD, runtime dispatch.
void chiSquaredBlocks(const float* query, std::size_t bins, const float* table, std::size_t blocks, float* distances);

/// The same for chosen rows of a row-major table: `distances[i]` belongs to row `rows[i]`. `bins` must be a multiple of
/// block_words; pad with zeros, which add nothing.
void chiSquaredRows(const float* query, std::size_t bins, const float* table, const std::uint32_t* rows,
                    std::size_t count, float* distances);

/// Index of the (first) smallest of `count` > 0 values.
std::size_t indexOfSmallest(const float* values, std::size_t count);

/// Writes the indices of the values that are not above `limit`, ascending, and returns how many; `indices` must have
/// room for `count` + block_words.
std::size_t selectUpTo(float limit, const float* values, std::size_t count, std::uint32_t* indices);

/// Chi squared distance in single precision (relative error below 1e-5). SIMD, runtime dispatch.
float chiSquaredFast(const float* a, const float* b, std::size_t size);

}  // namespace sks
