// SPDX-License-Identifier: BSD-3-Clause
#include "io/number_text.hpp"

#include <clocale>
#include <cstdlib>

namespace sks {

bool parseNumber(const std::string& word, double& value) {
  static const locale_t c_locale = ::newlocale(LC_ALL_MASK, "C", nullptr);
  char* end = nullptr;
  value = ::strtod_l(word.c_str(), &end, c_locale);
  return !word.empty() && end == word.c_str() + word.size();
}

}  // namespace sks
