// SPDX-License-Identifier: BSD-3-Clause
#include "core/settings/settings_table.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "core/settings/settings_overlay.hpp"
#include "error_of.hpp"

namespace {

using sks::ErrorCode;
using sks::test::errorOf;

struct Wheels {
  int count = 4;
  double radius = 0.3;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v(s.count, "count", sks::Range{3, 6}, "", "how many");
    v(s.radius, "radius", sks::Range{0.1, 1}, "m", "of each");
  }
};

struct Cart {
  Wheels wheels;
  std::string name = "cart";
  bool brakes = true;
  sks::KeypointDetector detector = sks::KeypointDetector::grid;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v.group("wheels", s.wheels);
    v(s.name, "name", "what is written on it");
    v(s.brakes, "brakes", "whether it can stop", sks::Binding::codebook);
    v(s.detector, "detector", "what it sees with");
  }
};

struct Horse {
  double speed = 5;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v(s.speed, "speed", sks::Range{0, 20}, "m/s", "how fast it goes");
  }
};

const sks::SettingsTable<Cart>& cartTable() {
  static const sks::SettingsTable<Cart> table(
      {{"tyres.radius", "wheels.radius", "", ""}, {"wheels.count", "brakes", "0", "false"}});
  return table;
}

const sks::SettingsTable<Horse>& horseTable() {
  static const sks::SettingsTable<Horse> table;
  return table;
}

std::string setError(const std::string& key, const std::string& text) {
  Cart cart;
  return errorOf(ErrorCode::bad_usage, [&] { cartTable().set(cart, key, text); });
}

}  // namespace

TEST(SettingsTable, DescribesEachType) {
  const auto& infos = cartTable().infos();
  ASSERT_EQ(infos.size(), 5u);
  const char* expected[][4] = {{"wheels.count", "int", "4", "3 to 6"},
                               {"wheels.radius", "double", "0.3", "0.1 to 1 [m]"},
                               {"name", "string", "cart", "any text"},
                               {"brakes", "bool", "true", "true, false"},
                               {"detector", "choice", "grid", "grid, iss"}};
  for (std::size_t i = 0; i < infos.size(); ++i) {
    EXPECT_EQ(infos[i].key, expected[i][0]);
    EXPECT_EQ(infos[i].type, expected[i][1]);
    EXPECT_EQ(infos[i].default_value, expected[i][2]);
    EXPECT_EQ(sks::allowedValues(infos[i]), expected[i][3]);
    EXPECT_EQ(infos[i].binding == sks::Binding::codebook, infos[i].key == "brakes");
    EXPECT_FALSE(infos[i].help.empty());
  }
}

TEST(SettingsTable, TakesBackWhatItGives) {
  Cart cart;
  const char* values[][2] = {
      {"wheels.count", "6"}, {"wheels.radius", "0.125"}, {"name", "a map"}, {"brakes", "false"}, {"detector", "iss"}};
  for (const auto& [key, text] : values) {
    EXPECT_EQ(cartTable().set(cart, key, text), "");
    EXPECT_EQ(cartTable().get(cart, key), text);
  }
  EXPECT_EQ(cart.wheels.count, 6);
  EXPECT_EQ(cart.wheels.radius, 0.125);
  EXPECT_EQ(cart.name, "a map");
  EXPECT_FALSE(cart.brakes);
  EXPECT_EQ(cart.detector, sks::KeypointDetector::iss);
}

TEST(SettingsTable, RefusesInOneWording) {
  EXPECT_EQ(setError("wheels.radius", "2"), "wheels.radius = 2 is out of range: 0.1 to 1 [m]");
  EXPECT_EQ(setError("wheels.radius", "big"), "wheels.radius = big: expected a number in 0.1 to 1 [m]");
  EXPECT_EQ(setError("wheels.radius", "nan"), "wheels.radius = nan: expected a number in 0.1 to 1 [m]");
  EXPECT_EQ(setError("wheels.count", "2"), "wheels.count = 2 is out of range: 3 to 6");
  EXPECT_EQ(setError("wheels.count", "4.5"), "wheels.count = 4.5: expected a whole number in 3 to 6");
  EXPECT_EQ(setError("brakes", "maybe"), "brakes = maybe: expected true or false");
  EXPECT_EQ(setError("detector", "eye"), "detector = eye: expected one of grid, iss");
  EXPECT_EQ(setError("radius", "1"), "unknown setting 'radius': did you mean 'wheels.radius'?");
  EXPECT_EQ(setError("brakes.count", "1"), "unknown setting 'brakes.count': did you mean 'wheels.count'?");
  EXPECT_EQ(errorOf(ErrorCode::bad_usage, [] { cartTable().get(Cart(), "nmae"); }),
            "unknown setting 'nmae': did you mean 'name'?");
}

TEST(SettingsTable, ChecksRangesOfWhatWasSetOtherwise) {
  Cart cart;
  EXPECT_NO_THROW(cartTable().checkRanges(cart));
  cart.wheels.radius = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(errorOf(ErrorCode::bad_usage, [&] { cartTable().checkRanges(cart); }),
            "wheels.radius = nan is out of range: 0.1 to 1 [m]");
}

TEST(SettingsTable, UnderstandsOldNames) {
  Cart cart;
  EXPECT_EQ(cartTable().set(cart, "tyres.radius", "0.5"),
            "'tyres.radius' is now called 'wheels.radius'; the old name still works");
  EXPECT_EQ(cart.wheels.radius, 0.5);
  EXPECT_EQ(cartTable().get(cart, "tyres.radius"), "0.5");
  EXPECT_EQ(cartTable().set(cart, "wheels.count", "0"),
            "'wheels.count = 0' is now called 'brakes = false'; the old name still works");
  EXPECT_EQ(cart.wheels.count, 4);
  EXPECT_FALSE(cart.brakes);
  EXPECT_EQ(cartTable().get(cart, "wheels.count"), "4");
  EXPECT_EQ(setError("tyres.radius", "7"), "wheels.radius = 7 is out of range: 0.1 to 1 [m]");
  EXPECT_EQ(setError("wheels.count", "-1"), "wheels.count = -1 is out of range: 3 to 6");
}

TEST(SettingsOverlay, SetsSeveralTablesAtOnce) {
  Cart cart;
  Horse horse;
  sks::SettingsOverlay overlay({cartTable().bind(cart), horseTable().bind(horse)});
  overlay.set("speed", "12");
  overlay.set("wheels.count", "3");
  EXPECT_EQ(horse.speed, 12);
  EXPECT_EQ(cart.wheels.count, 3);
  EXPECT_EQ(overlay.get("speed"), "12");
  EXPECT_EQ(errorOf(ErrorCode::bad_usage, [&] { overlay.set("sped", "1"); }),
            "unknown setting 'sped': did you mean 'speed'?");
  EXPECT_EQ(errorOf(ErrorCode::bad_usage, [&] { overlay.refuse("name", "a list"); }), "name = a list: expected text");
  EXPECT_TRUE(overlay.isGroup("wheels") && overlay.isGroup("tyres"));
  EXPECT_FALSE(overlay.isGroup("speed") || overlay.isGroup("wheel"));
  EXPECT_TRUE(overlay.isKey("speed") && overlay.isKey("tyres.radius"));
  EXPECT_FALSE(overlay.isKey("wheels"));
}

TEST(SettingsOverlay, RefusesASettingThatIsSetTwice) {
  Cart cart;
  const auto twice = [&](const char* first, const char* second) {
    sks::SettingsOverlay overlay({cartTable().bind(cart)});
    overlay.set(first, "0.5");
    return errorOf(ErrorCode::bad_usage, [&] { overlay.set(second, "0.6"); });
  };
  EXPECT_EQ(twice("wheels.radius", "wheels.radius"), "'wheels.radius' is set twice; keep one");
  EXPECT_EQ(twice("tyres.radius", "wheels.radius"), "'wheels.radius' is set twice, also as 'tyres.radius'; keep one");
  EXPECT_EQ(twice("wheels.radius", "tyres.radius"), "'wheels.radius' is set twice, also as 'tyres.radius'; keep one");
  EXPECT_EQ(cart.wheels.radius, 0.5);
}
