// SPDX-License-Identifier: BSD-3-Clause
#include "io/lzf.hpp"

namespace sks {

bool decompressLzf(const std::vector<std::uint8_t>& packed, std::size_t size, std::vector<std::uint8_t>& data) {
  data.clear();
  data.reserve(size);
  for (std::size_t at = 0; at < packed.size();) {
    const std::uint8_t control = packed[at++];
    if (control < 32) {  // control + 1 bytes as they are
      const std::size_t count = control + 1u;
      if (packed.size() - at < count || size - data.size() < count) return false;
      data.insert(data.end(), &packed[at], &packed[at] + count);
      at += count;
      continue;
    }
    std::size_t count = control >> 5;  // the same bytes as a while ago; they may overlap with those to come
    if (count == 7) {
      if (at == packed.size()) return false;
      count += packed[at++];
    }
    count += 2;
    if (at == packed.size()) return false;
    const std::size_t distance = ((control & 31u) << 8 | packed[at++]) + 1u;
    if (distance > data.size() || size - data.size() < count) return false;
    for (std::size_t i = 0; i < count; ++i) data.push_back(data[data.size() - distance]);
  }
  return data.size() == size;
}

}  // namespace sks
