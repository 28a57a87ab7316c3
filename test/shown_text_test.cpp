// SPDX-License-Identifier: BSD-3-Clause
#include "core/settings/shown_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/error.hpp>

#include "core/settings/name_text.hpp"
#include "core/settings/utf8.hpp"
#include "error_of.hpp"

namespace sks {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(ShownText, LeavesPlainTextAsItIs) {
  for (const std::string text : {"", "mario", "größe 3 × 4", "日本", "a'b\"c\\d"}) EXPECT_EQ(shown(text), text);
}

TEST(ShownText, EscapesWhatMovesCursorsOrEndsLines) {
  EXPECT_EQ(shown("a\nb\tc\rd"), "a\\nb\\tc\\rd");
  EXPECT_EQ(shown("\x1b[31mred"), "\\x1b[31mred");
  EXPECT_EQ(shown(std::string("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(shown("caf\xe9"), "caf\\xe9");
  EXPECT_EQ(shown("\x7f"), "\\x7f");
  EXPECT_EQ(shown("\xc2\x9b"
                  "31m"),
            "\\xc2\\x9b"
            "31m");  // the one-character form of ESC [
}

TEST(ShownText, ShortensTheMiddle) {
  for (const std::string& text : {std::string(20000000, 'x'), std::string(500, '\n'), std::string(300, '\xff')}) {
    const std::string result = shown(text, 100);
    EXPECT_LE(result.size(), 100u);
    EXPECT_THAT(result, HasSubstr("(" + std::to_string(text.size()) + " bytes)"));
  }
  const std::string result = shown("begin" + std::string(1000, '-') + "end", 100);
  EXPECT_THAT(result, StartsWith("begin"));
  EXPECT_EQ(result.substr(result.size() - 3), "end");
}

TEST(ShownText, CutsNoCharacterInTwo) {
  std::string umlauts;
  for (int i = 0; i < 500; ++i) umlauts += "ä";
  for (std::size_t most = 60; most < 80; ++most) {
    EXPECT_TRUE(isUtf8(shown(umlauts, most))) << most;
    EXPECT_TRUE(isUtf8(shown("x" + umlauts, most))) << most;
  }
}

TEST(ShownText, ListsTheFirstOfManyNames) {
  EXPECT_EQ(shownList({"a", "b\n"}), "a, b\\n");
  const std::string list = shownList(std::vector<std::string>(1000, std::string(1000, 'x')));
  EXPECT_LE(list.size(), 1000u);
  EXPECT_THAT(list, HasSubstr(" and 988 more"));
}

TEST(ShownText, ErrorsAreOneBoundedLine) {
  const Error error(ErrorCode::bad_data,
                    "the field '" + std::string(20000000, 'x') + "\x1b[2J\n' is unknown: rename it");
  const std::string message = error.what();
  EXPECT_LE(message.size(), 4000u);
  EXPECT_EQ(message.find('\n'), std::string::npos);
  EXPECT_EQ(message.find('\x1b'), std::string::npos);
  EXPECT_THAT(message, HasSubstr("is unknown: rename it"));
}

TEST(NameText, RefusesWhatIsNoName) {
  EXPECT_EQ(nameFault("mug 3, größer"), "");
  EXPECT_EQ(nameFault(std::string(200, 'x')), "");
  EXPECT_THAT(nameFault(""), HasSubstr("empty"));
  EXPECT_THAT(nameFault(std::string(201, 'x')), HasSubstr("it has 201 bytes; use at most 200"));
  for (const std::string& name : {std::string("a\nb"), std::string("\x1b[31m"), std::string("a\0b", 3),
                                  std::string("\x7f"), std::string("a\xc2\x85")}) {
    EXPECT_THAT(nameFault(name), HasSubstr("control character"));
  }
  for (const std::string name : {"caf\xe9", "\xc3", "\xed\xa0\x80", "\xff"}) {
    EXPECT_THAT(nameFault(name), HasSubstr("not UTF-8"));
  }
  EXPECT_EQ(test::errorOf(ErrorCode::bad_usage, [] { checkName("a\nb", "the object's name"); }),
            "the object's name 'a\\nb' is refused: it contains a control character; leave that out");
}

}  // namespace
}  // namespace sks
