// SPDX-License-Identifier: BSD-3-Clause
#include "io/number_text.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/settings/number_format.hpp"
#include "core/settings/value_text.hpp"
#include "foreign_locale.hpp"

namespace sks {
namespace {

TEST(NumberText, ReadsWhatOtherProgramsWriteForNoNumber) {
  for (const char* word :
       {"nan", "NaN", "-nan", "+nan", "nan(ind)", "-nan(ind)", "NAN(SNAN)", "1.#QNAN", "1.#QNAN0", "-1.#IND",
        "-1.#IND00", "1.#IND", "1.#SNAN", "1.#R", "1.#QO", "-1.#J", ".nan", "NaNQ", "qnan"}) {
    double value = 0;
    EXPECT_TRUE(parseNumber(word, value)) << word;
    EXPECT_TRUE(std::isnan(value)) << word;
  }
  for (const char* word : {"inf", "Inf", "+inf", "INFINITY", "1.#INF", "1.#INF00", ".inf"}) {
    double value = 0;
    EXPECT_TRUE(parseNumber(word, value)) << word;
    EXPECT_EQ(value, HUGE_VAL) << word;
  }
  for (const char* word : {"-inf", "-1.#INF", "-Infinity", "-.inf"}) {
    double value = 0;
    EXPECT_TRUE(parseNumber(word, value)) << word;
    EXPECT_EQ(value, -HUGE_VAL) << word;
  }
}

TEST(NumberText, ReadsNumbersAndNothingElse) {
  double value = 0;
  EXPECT_TRUE(parseNumber("-1.5e-3", value));
  EXPECT_EQ(value, -1.5e-3);
  for (const char* word : {"", " 1", "1 ", "1,5", "1.#", "#QNAN", "nane", "info", "--1", "1.5.", "x", "-", "."}) {
    EXPECT_FALSE(parseNumber(word, value)) << word;
  }
}

TEST(NumberText, LinesMayEndInEveryWay) {
  std::istringstream stream = plainStream(
      "\xef\xbb\xbf"
      "a\rb\r\nc\n\rd");
  std::string all;
  for (std::string line; std::getline(stream, line);) all += line + "|";
  EXPECT_EQ(all, "a|b|c||d|");
}

TEST(ForeignLocale, ChangesNoNumber) {
  const test::CommaLocale foreign;
  EXPECT_EQ(formatted("%.3f %zu %g", 1234.5, std::size_t(1234567), 0.109), "1234.500 1234567 0.109");
  EXPECT_EQ(toText(1234.5), "1234.5");
  EXPECT_EQ(toText(1234567), "1234567");
  double value = 0;
  EXPECT_TRUE(fromText("0.109", value));
  EXPECT_EQ(value, 0.109);
  EXPECT_TRUE(parseNumber("1234.5", value));
  EXPECT_EQ(value, 1234.5);
  EXPECT_FALSE(parseNumber("1234,5", value));
  int whole = 0;
  EXPECT_TRUE(bool(plainStream("12.5 1234567") >> value >> whole));
  EXPECT_EQ(value, 12.5);
  EXPECT_EQ(whole, 1234567);
}

}  // namespace
}  // namespace sks
