// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace sks {

/// Undoes LZF compression, as PCD files have it.
/// @param size of the data before it was compressed [bytes]; allocated, so to be checked before
/// @return false where the data do not give exactly that many bytes
bool decompressLzf(const std::vector<std::uint8_t>& packed, std::size_t size, std::vector<std::uint8_t>& data);

}  // namespace sks
