// SPDX-License-Identifier: BSD-3-Clause
#include "core/settings/number_format.hpp"

#include <cstdarg>
#include <cstdio>

#include <locale.h>

namespace sks {
namespace {

/// Gives the thread the locale "C" in its scope.
class PlainNumbers {
public:
  PlainNumbers() : before_(::uselocale(plain())) {}
  ~PlainNumbers() { ::uselocale(before_); }
  PlainNumbers(const PlainNumbers&) = delete;
  PlainNumbers& operator=(const PlainNumbers&) = delete;

private:
  static locale_t plain() {
    static const locale_t locale = ::newlocale(LC_ALL_MASK, "C", nullptr);
    return locale;
  }

  locale_t before_;
};

}  // namespace

std::string formatted(const char* format, ...) {
  const PlainNumbers plain;
  char text[512];
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof(text), format, arguments);
  va_end(arguments);
  return text;
}

}  // namespace sks
