// SPDX-License-Identifier: BSD-3-Clause
#include "io/number_text.hpp"

#include <algorithm>
#include <cctype>
#include <clocale>
#include <cstdlib>
#include <limits>
#include <locale>

namespace sks {
namespace {

/// What other programs print for numbers that are not finite: `1.#QNAN` and `-1.#IND000` (Microsoft's C library),
/// `nan(ind)`, `-nan`, `NaNQ`, `Infinity`, `.inf`.
bool parseNotFinite(std::string word, double& value) {
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  const bool negative = !word.empty() && word[0] == '-';
  if (!word.empty() && (word[0] == '-' || word[0] == '+')) word.erase(0, 1);
  const auto begins = [&](const std::string& with) { return word.compare(0, with.size(), with) == 0; };
  const bool microsoft = begins("1.#");
  if (microsoft) {
    word.erase(0, 3);
    word.erase(word.find_last_not_of('0') + 1);  // as many as the precision asks for
  } else if (begins(".")) {
    word.erase(0, 1);
  }
  const bool braces = begins("nan(") && word.back() == ')';
  const bool infinite = word == "inf" || word == "infinity" || word == "infinite";
  const bool nan = braces || word == "nan" || word == "qnan" || word == "snan" || word == "nanq" || word == "nans" ||
                   (microsoft && !word.empty() && !infinite);  // rounded, its last letter may be the next one: 1.#J
  if (!infinite && !nan) return false;
  value = infinite ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
  if (negative) value = -value;
  return true;
}

}  // namespace

bool parseNumber(const std::string& word, double& value) {
  static const locale_t c_locale = ::newlocale(LC_ALL_MASK, "C", nullptr);
  if (word.empty() || std::isspace(static_cast<unsigned char>(word[0])) != 0) return false;
  char* end = nullptr;
  value = ::strtod_l(word.c_str(), &end, c_locale);
  return end == word.c_str() + word.size() || parseNotFinite(word, value);
}

std::istringstream plainStream(std::string text) {
  if (text.compare(0, 3, "\xef\xbb\xbf") == 0) text.erase(0, 3);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n') continue;
    text[kept++] = text[i] == '\r' ? '\n' : text[i];
  }
  text.resize(kept);
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  return stream;
}

}  // namespace sks
