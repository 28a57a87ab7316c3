// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace sks {

/// CRC-32C (Castagnoli polynomial, as in RFC 3720).
/// @param previous checksum of the bytes before, to go on from
std::uint32_t crc32c(const void* data, std::size_t size, std::uint32_t previous = 0);

}  // namespace sks
