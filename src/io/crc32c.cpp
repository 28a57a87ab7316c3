// SPDX-License-Identifier: BSD-3-Clause
#include "io/crc32c.hpp"

#include <array>

namespace sks {
namespace {

using Tables = std::array<std::array<std::uint32_t, 256>, 8>;

/// tables[k][b] is the checksum of byte b followed by k zeros, so that eight bytes are done at once.
Tables makeTables() {
  constexpr std::uint32_t reflected_polynomial = 0x82f63b78;
  Tables tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? reflected_polynomial : 0);
    tables[0][byte] = crc;
  }
  for (std::size_t k = 1; k < 8; ++k) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t before = tables[k - 1][byte];
      tables[k][byte] = before >> 8 ^ tables[0][before & 0xff];
    }
  }
  return tables;
}

}  // namespace

std::uint32_t crc32c(const void* data, std::size_t size, std::uint32_t previous) {
  static const Tables tables = makeTables();
  const auto* next = static_cast<const unsigned char*>(data);
  std::uint32_t crc = ~previous;
  for (; size >= 8; size -= 8, next += 8) {
    crc = tables[7][(crc ^ next[0]) & 0xff] ^ tables[6][(crc >> 8 ^ next[1]) & 0xff] ^
          tables[5][(crc >> 16 ^ next[2]) & 0xff] ^ tables[4][(crc >> 24 ^ next[3]) & 0xff] ^ tables[3][next[4]] ^
          tables[2][next[5]] ^ tables[1][next[6]] ^ tables[0][next[7]];
  }
  for (; size > 0; --size, ++next) crc = crc >> 8 ^ tables[0][(crc ^ *next) & 0xff];
  return ~crc;
}

}  // namespace sks
