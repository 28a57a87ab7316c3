// SPDX-License-Identifier: BSD-3-Clause
#include "io/utf8.hpp"

#include <cstdint>

namespace sks {
namespace {

/// Bytes that follow the first one of a character; -1 for a byte that starts none.
int followers(unsigned char first) {
  if (first < 0x80) return 0;
  if (first >= 0xc2 && first < 0xe0) return 1;
  if (first >= 0xe0 && first < 0xf0) return 2;
  return first >= 0xf0 && first < 0xf5 ? 3 : -1;
}

bool isCharacter(std::uint32_t code, int length) {
  constexpr std::uint32_t smallest[] = {0, 0x80, 0x800, 0x10000};  // a longer form than needed is none
  const bool surrogate = code >= 0xd800 && code <= 0xdfff;
  const bool noncharacter = (code & 0xfffe) == 0xfffe || (code >= 0xfdd0 && code <= 0xfdef);
  return code >= smallest[length] && code <= 0x10ffff && !surrogate && !noncharacter;
}

}  // namespace

bool isUtf8(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto first = static_cast<unsigned char>(text[i]);
    const int length = followers(first);
    if (length < 0 || text.size() - i <= std::size_t(length)) return false;
    std::uint32_t code = length == 0 ? first : first & (0x3fu >> length);
    for (int k = 0; k < length; ++k) {
      const auto next = static_cast<unsigned char>(text[++i]);
      if ((next & 0xc0) != 0x80) return false;
      code = code << 6 | (next & 0x3fu);
    }
    if (!isCharacter(code, length)) return false;
  }
  return true;
}

}  // namespace sks
