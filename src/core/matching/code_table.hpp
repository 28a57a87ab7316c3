// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sks {

/// Words that stand side by side in one block of a table of codes.
constexpr std::size_t block_words = 16;
/// Coordinates of a code.
constexpr std::size_t code_size = 64;
/// Numbers of one block of a table of codes: [pair of coordinates][word][coordinate of the pair].
constexpr std::size_t block_size = block_words * code_size;
/// Queries that one pass over a table serves.
constexpr std::size_t queries_at_once = 4;

/// The longest code that keeps inner products within 32 bits, with some room.
constexpr float code_length = 30000;

using Code = std::array<std::int16_t, code_size>;

/// Coordinates, each histogram's in a unit of its own.
struct CodedVector {
  Code code;
  float unit;     ///< of the numbers in the code
  float squares;  ///< of the coordinates
};

/// Words coded in blocks.
struct CodeTable {
  std::vector<std::int16_t> codes;  ///< block_size for each block
  std::vector<float> units;         ///< of each word
  std::vector<float> squares;       ///< of each word's coordinates; infinite where there is no word

  explicit CodeTable(std::size_t words = 0);
  std::size_t blocks() const { return units.size() / block_words; }
  void set(std::size_t word, const CodedVector& vector);
};

/// Squared distances between each query's coordinates and those of each word of `blocks` blocks. SIMD, runtime
/// dispatch.
void codeDistances(const std::array<const CodedVector*, queries_at_once>& queries, const CodeTable& table,
                   std::size_t first_block, std::size_t blocks, const std::array<float*, queries_at_once>& distances);

}  // namespace sks
