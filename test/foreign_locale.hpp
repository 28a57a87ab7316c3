// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <clocale>
#include <locale>
#include <string>

namespace sks::test {

/// Numbers as in Germany, without a locale of the system.
class CommaNumbers : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

/// In its scope the program runs under the locale of a country with a decimal comma, as a library may set it.
class CommaLocale {
public:
  CommaLocale() : before_(std::locale::global(std::locale(std::locale::classic(), new CommaNumbers))) {
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "nl_NL.UTF-8"}) {
      if (std::setlocale(LC_ALL, name) != nullptr) break;  // also C's, where the system has one
    }
  }
  ~CommaLocale() {
    std::locale::global(before_);
    std::setlocale(LC_ALL, "C");
  }
  CommaLocale(const CommaLocale&) = delete;
  CommaLocale& operator=(const CommaLocale&) = delete;

private:
  std::locale before_;
};

}  // namespace sks::test
