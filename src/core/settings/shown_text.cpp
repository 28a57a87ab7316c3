// SPDX-License-Identifier: BSD-3-Clause
#include "core/settings/shown_text.hpp"

#include <algorithm>

#include "core/settings/utf8.hpp"

namespace sks {
namespace {

constexpr std::size_t longest_message = 4000;  // [bytes]
constexpr std::size_t most_names = 12;         // of a list

std::string escaped(unsigned char c) {
  if (c == '\n') return "\\n";
  if (c == '\t') return "\\t";
  if (c == '\r') return "\\r";
  constexpr const char* digits = "0123456789abcdef";
  return std::string("\\x") + digits[c >> 4] + digits[c & 15];
}

/// The characters as they are shown, each whole, until they take `most` bytes; from the end where `backwards`.
std::string shownPart(const std::string& text, std::size_t most) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t size = characterSize(text, i);
    const bool plain = size > 0 && !isControl(text, i);
    const std::string next = plain ? text.substr(i, size) : escaped(static_cast<unsigned char>(text[i]));
    if (result.size() + next.size() > most) break;
    result += next;
    i += plain ? size : 1;
  }
  return result;
}

bool isFit(const std::string& text) {
  return !hasControl(text) && isUtf8(text);
}

}  // namespace

std::string shown(const std::string& text, std::size_t most) {
  if (text.size() <= most && isFit(text)) return text;
  const std::string whole = text.size() <= most ? shownPart(text, 4 * most) : "";
  if (!whole.empty() && whole.size() <= most) return whole;
  const std::string gap = " ... (" + std::to_string(text.size()) + " bytes) ... ";
  const std::size_t room = most > gap.size() ? most - gap.size() : 0, of_end = room / 3;
  std::size_t end = text.size() - std::min(text.size(), of_end);
  std::string last = shownPart(text.substr(end), 4 * of_end);
  while (last.size() > of_end) {  // escapes take up to four bytes for one
    end += (last.size() - of_end + 3) / 4;
    last = shownPart(text.substr(end), 4 * of_end);
  }
  const std::size_t begin = end;
  while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) ++end;  // not within a character
  if (end > begin) last = shownPart(text.substr(end), of_end);
  return shownPart(text, room - of_end) + gap + last;
}

std::string shownList(const std::vector<std::string>& names) {
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), most_names); ++i) {
    list += (i > 0 ? ", " : "") + shown(names[i], 60);
  }
  if (names.size() > most_names) list += " and " + std::to_string(names.size() - most_names) + " more";
  return list;
}

std::string shownMessage(const std::string& message) {
  return shown(message, longest_message);
}

}  // namespace sks
