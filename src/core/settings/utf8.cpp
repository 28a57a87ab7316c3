// SPDX-License-Identifier: BSD-3-Clause
#include "core/settings/utf8.hpp"

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

std::size_t characterSize(const std::string& text, std::size_t begin) {
  if (begin >= text.size()) return 0;
  const auto first = static_cast<unsigned char>(text[begin]);
  const int length = followers(first);
  if (length < 0 || text.size() - begin <= std::size_t(length)) return 0;
  std::uint32_t code = length == 0 ? first : first & (0x3fu >> length);
  for (int k = 1; k <= length; ++k) {
    const auto next = static_cast<unsigned char>(text[begin + std::size_t(k)]);
    if ((next & 0xc0) != 0x80) return 0;
    code = code << 6 | (next & 0x3fu);
  }
  return isCharacter(code, length) ? std::size_t(length) + 1 : 0;
}

std::size_t firstNoUtf8(const std::string& text) {
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t size = characterSize(text, at);
    if (size == 0) break;
    at += size;
  }
  return at;
}

bool isUtf8(const std::string& text) {
  return firstNoUtf8(text) == text.size();
}

bool isControl(const std::string& text, std::size_t begin) {
  const auto first = static_cast<unsigned char>(text[begin]);
  const bool second_set = first == 0xc2 && characterSize(text, begin) == 2;
  return first < 0x20 || first == 0x7f || (second_set && static_cast<unsigned char>(text[begin + 1]) < 0xa0);
}

bool hasControl(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (isControl(text, i)) return true;
  }
  return false;
}

}  // namespace sks
