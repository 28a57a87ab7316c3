// SPDX-License-Identifier: BSD-3-Clause
#include "io/crc32c.hpp"

#include <array>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "io/crc32c.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#ifndef SKS_CRC32C_ONCE
#define SKS_CRC32C_ONCE
namespace sks {

using CrcTables = std::array<std::array<std::uint32_t, 256>, 8>;

/// tables[k][b] is the checksum of byte b followed by k zeros, so that eight bytes are done at once.
inline CrcTables makeCrcTables() {
  constexpr std::uint32_t reflected_polynomial = 0x82f63b78;
  CrcTables tables{};
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

}  // namespace sks
#endif

HWY_BEFORE_NAMESPACE();
namespace sks {
namespace HWY_NAMESPACE {

std::uint32_t crc32cImpl(const unsigned char* next, std::size_t size, std::uint32_t crc) {
#if HWY_ARCH_X86_64 && HWY_TARGET <= HWY_SSE4  // has an instruction for this polynomial
  std::uint64_t wide = crc;
  for (; size >= 8; size -= 8, next += 8) {
    unsigned long long eight = 0;
    std::memcpy(&eight, next, sizeof eight);
    wide = __builtin_ia32_crc32di(wide, eight);
  }
  crc = std::uint32_t(wide);
  for (; size > 0; --size, ++next) crc = __builtin_ia32_crc32qi(crc, *next);
#else
  static const CrcTables tables = makeCrcTables();
  for (; size >= 8; size -= 8, next += 8) {
    crc = tables[7][(crc ^ next[0]) & 0xff] ^ tables[6][(crc >> 8 ^ next[1]) & 0xff] ^
          tables[5][(crc >> 16 ^ next[2]) & 0xff] ^ tables[4][(crc >> 24 ^ next[3]) & 0xff] ^ tables[3][next[4]] ^
          tables[2][next[5]] ^ tables[1][next[6]] ^ tables[0][next[7]];
  }
  for (; size > 0; --size, ++next) crc = crc >> 8 ^ tables[0][(crc ^ *next) & 0xff];
#endif
  return crc;
}

}  // namespace HWY_NAMESPACE
}  // namespace sks
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sks {

HWY_EXPORT(crc32cImpl);

std::uint32_t crc32c(const void* data, std::size_t size, std::uint32_t previous) {
  return ~HWY_DYNAMIC_DISPATCH(crc32cImpl)(static_cast<const unsigned char*>(data), size, ~previous);
}

}  // namespace sks
#endif
