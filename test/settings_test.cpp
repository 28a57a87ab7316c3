// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/settings.hpp>

#include <cmath>
#include <limits>
#include <locale>
#include <set>

#include <gtest/gtest.h>

#include "error_of.hpp"

namespace {

template <typename Action>
std::string usageError(Action action) {
  return sks::test::errorOf(sks::ErrorCode::bad_usage, action);
}

std::string settingError(const std::string& key, const std::string& value) {
  return usageError([&] {
    sks::Settings settings;
    sks::setSetting(settings, key, value);
  });
}

std::string validateError(const sks::Settings& settings) {
  return usageError([&] { sks::validate(settings); });
}

const sks::SettingInfo& info(const std::string& key) {
  for (const sks::SettingInfo& candidate : sks::settingInfos()) {
    if (candidate.key == key) return candidate;
  }
  throw std::out_of_range(key);
}

struct CommaPoint : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

}  // namespace

TEST(Settings, InfosDescribeEverySettingOnce) {
  std::set<std::string> keys;
  for (const sks::SettingInfo& each : sks::settingInfos()) {
    EXPECT_TRUE(keys.insert(each.key).second) << each.key << " appears twice";
    EXPECT_FALSE(each.help.empty()) << each.key;
    EXPECT_EQ(each.type == "choice", !each.choices.empty()) << each.key;
    if (each.type == "double" || each.type == "int") {
      EXPECT_TRUE(std::isfinite(each.range.min) && std::isfinite(each.range.max)) << each.key << " has no range";
    }
  }
  const sks::SettingInfo& radius = info("descriptor.radius");
  EXPECT_EQ(radius.type, "double");
  EXPECT_EQ(radius.unit, "m");
  EXPECT_EQ(radius.range.min, 0.002);
  EXPECT_EQ(radius.range.max, 1);
  EXPECT_EQ(radius.binding, sks::Binding::codebook);
  EXPECT_EQ(info("keypoints.discard").binding, sks::Binding::free);
  EXPECT_EQ(info("descriptor.type").choices, (std::vector<std::string>{"auto", "shot", "cshot"}));
  EXPECT_EQ(info("ransac.seed").type, "int");
  EXPECT_EQ(info("sanitize.crop").type, "bool");
  EXPECT_EQ(info("threads").default_value, "0");
}

TEST(Settings, DefaultsAreValid) {
  EXPECT_NO_THROW(sks::validate(sks::Settings()));
  for (const sks::SettingInfo& each : sks::settingInfos()) {
    EXPECT_EQ(sks::getSetting(sks::Settings(), each.key), each.default_value);
  }
}

TEST(Settings, EveryTextReadsBackUnchanged) {
  sks::Settings settings;
  for (const sks::SettingInfo& each : sks::settingInfos()) {
    sks::setSetting(settings, each.key, each.default_value);
    EXPECT_EQ(sks::getSetting(settings, each.key), each.default_value) << each.key;
  }
}

TEST(Settings, SetsEachType) {
  sks::Settings settings;
  sks::setSetting(settings, "keypoints.discard", "0.75");
  sks::setSetting(settings, "ransac.iterations", "17");
  sks::setSetting(settings, "sanitize.crop", "true");
  sks::setSetting(settings, "descriptor.type", "cshot");
  sks::setSetting(settings, "threads", "3");
  EXPECT_EQ(settings.keypoints.discard, 0.75);
  EXPECT_EQ(settings.ransac.iterations, 17);
  EXPECT_TRUE(settings.sanitize.crop);
  EXPECT_EQ(settings.descriptor.type, sks::DescriptorType::cshot);
  EXPECT_EQ(settings.threads, 3);
}

TEST(Settings, DoublesPrintShortAndExact) {
  sks::Settings settings;
  const std::pair<double, const char*> values[] = {{0.1, "0.1"}, {0.02, "0.02"}, {1e-5, "1e-05"}, {0, "0"}};
  for (const auto& [value, text] : values) {
    settings.keypoints.discard = value;
    EXPECT_EQ(sks::getSetting(settings, "keypoints.discard"), text);
  }
  for (const double value : {1.0 / 3, 0.1 + 0.2, std::nextafter(0.5, 1.0)}) {
    settings.keypoints.discard = value;
    sks::Settings back;
    sks::setSetting(back, "keypoints.discard", sks::getSetting(settings, "keypoints.discard"));
    EXPECT_EQ(back.keypoints.discard, value);
  }
}

TEST(Settings, TextDoesNotDependOnTheLocale) {
  const std::locale previous = std::locale::global(std::locale(std::locale::classic(), new CommaPoint));
  sks::Settings settings;
  settings.sanitize.max_range = 1000;
  settings.keypoints.discard = 0.25;
  settings.ransac.seed = 2147483647;
  const std::string range = sks::getSetting(settings, "sanitize.max_range");
  const std::string discard = sks::getSetting(settings, "keypoints.discard");
  const std::string seed = sks::getSetting(settings, "ransac.seed");
  sks::setSetting(settings, "keypoints.discard", "0.5");
  std::locale::global(previous);
  EXPECT_EQ(range, "1000");
  EXPECT_EQ(discard, "0.25");
  EXPECT_EQ(seed, "2147483647");
  EXPECT_EQ(settings.keypoints.discard, 0.5);
}

TEST(Settings, UnknownKeyNamesTheNearest) {
  EXPECT_EQ(settingError("keypoints.discrad", "0.5"),
            "unknown setting 'keypoints.discrad': did you mean 'keypoints.discard'?");
  EXPECT_EQ(usageError([] { sks::getSetting(sks::Settings(), "thread"); }),
            "unknown setting 'thread': did you mean 'threads'?");
  EXPECT_EQ(sks::nearestSettingKey("discard"), "keypoints.discard");
  EXPECT_EQ(sks::nearestSettingKey("descriptor.grid_size"), "keypoints.grid_size");
  EXPECT_EQ(sks::nearestSettingKey("keypoint.discard"), "keypoints.discard");
  EXPECT_EQ(sks::nearestSettingKey("ransac.iteratoins"), "ransac.iterations");
  EXPECT_EQ(sks::nearestSettingKey(""), "");
  EXPECT_EQ(sks::nearestSettingKey("keypoints.banana"), "");
}

TEST(Settings, BadTextNamesTypeRangeAndUnit) {
  EXPECT_EQ(settingError("descriptor.radius", "abc"), "descriptor.radius = abc: expected a number in 0.002 to 1 [m]");
  EXPECT_EQ(settingError("ransac.seed", "1.5"), "ransac.seed = 1.5: expected a whole number in 0 to 2147483647");
  EXPECT_EQ(settingError("sanitize.crop", "1"), "sanitize.crop = 1: expected true or false");
  EXPECT_EQ(settingError("descriptor.type", "fpfh"), "descriptor.type = fpfh: expected one of auto, shot, cshot");
  EXPECT_EQ(settingError("keypoints.discard", "1.5"), "keypoints.discard = 1.5 is out of range: 0 to 0.99");
  EXPECT_EQ(settingError("ransac.iterations", "-1"), "ransac.iterations = -1 is out of range: 1 to 100000");
  for (const char* text : {"", " 0.5", "0.5 ", "0.5x", "0,5", "nan", "inf", "1e999", "--1"}) {
    EXPECT_EQ(settingError("keypoints.discard", text),
              std::string("keypoints.discard = ") + text + ": expected a number in 0 to 0.99");
  }
  EXPECT_EQ(settingError("threads", "99999999999"), "threads = 99999999999: expected a whole number in 0 to 256");
}

TEST(Settings, OldNamesStillWork) {
  sks::Settings settings;
  std::vector<std::string> warnings;
  sks::setSetting(settings, "verification.ambiguity", "1.1", &warnings);
  sks::setSetting(settings, "verification.skip_planes", "false", &warnings);
  sks::setSetting(settings, "verification.candidates", "0", &warnings);
  EXPECT_EQ(settings.matching.ambiguity, 1.1);
  EXPECT_FALSE(settings.keypoints.skip_planes);
  EXPECT_EQ(settings.detection.hypotheses, sks::Hypotheses::hough);
  EXPECT_EQ(settings.verification.candidates, sks::Settings().verification.candidates);
  EXPECT_EQ(sks::getSetting(settings, "verification.ambiguity"), "1.1");
  ASSERT_EQ(warnings.size(), 3u);
  EXPECT_EQ(warnings[0], "'verification.ambiguity' is now called 'matching.ambiguity'; the old name still works");
  EXPECT_NO_THROW(sks::setSetting(settings, "verification.ambiguity", "1.2"));
  EXPECT_EQ(settings.matching.ambiguity, 1.2);
  settings.verification.candidates = 0;
  EXPECT_EQ(validateError(settings), "verification.candidates = 0 is out of range: 1 to 1000");
}

TEST(Settings, HelpTellsWhatALargerOrSmallerNumberDoes) {
  for (const sks::SettingInfo& each : sks::settingInfos()) {
    if (each.type != "double" && each.type != "int") continue;
    const bool says = each.help.find("arger: ") != std::string::npos ||
                      each.help.find("maller: ") != std::string::npos ||
                      each.help.find("are dropped") != std::string::npos || each.key == "ransac.seed";
    EXPECT_TRUE(says) << each.key << ": " << each.help;
  }
}

TEST(Settings, RefusedValueLeavesTheOldOne) {
  sks::Settings settings;
  settings.keypoints.discard = 0.25;
  EXPECT_THROW(sks::setSetting(settings, "keypoints.discard", "7"), sks::Error);
  EXPECT_THROW(sks::setSetting(settings, "keypoints.discard", "x"), sks::Error);
  EXPECT_EQ(settings.keypoints.discard, 0.25);
}

TEST(Settings, ValidateChecksRangesAndNan) {
  sks::Settings settings;
  settings.keypoints.discard = -0.1;
  EXPECT_EQ(validateError(settings), "keypoints.discard = -0.1 is out of range: 0 to 0.99");
  settings.keypoints.discard = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(validateError(settings), "keypoints.discard = nan is out of range: 0 to 0.99");
  settings = {};
  settings.ransac.min_inliers = 0;
  EXPECT_NE(validateError(settings).find("ransac.min_inliers = 0 is out of range"), std::string::npos);
}

TEST(Settings, ValidateChecksWhatMustHoldBetweenSettings) {
  sks::Settings settings;
  settings.sanitize.min_range = 5;
  settings.sanitize.max_range = 2;
  EXPECT_EQ(validateError(settings), "sanitize.min_range = 5 must be less than sanitize.max_range = 2");
  settings = {};
  settings.sanitize.crop_min_z = settings.sanitize.crop_max_z = 1;
  EXPECT_EQ(validateError(settings), "sanitize.crop_min_z = 1 must be less than sanitize.crop_max_z = 1");
  settings = {};
  settings.surface.normal_radius = 0.06;
  settings.descriptor.radius = 0.05;
  EXPECT_EQ(validateError(settings), "surface.normal_radius = 0.06 must be less than descriptor.radius = 0.05");
  settings = {};
  settings.surface.resolution = 0.015;
  settings.surface.normal_radius = 0.01;
  EXPECT_EQ(validateError(settings), "surface.resolution = 0.015 must be less than surface.normal_radius = 0.01");
}

TEST(Settings, BindingConflictsAreThoseOfTheCodebook) {
  sks::Settings codebook, wanted;
  wanted.keypoints.discard = 0.75;
  wanted.threads = 2;
  EXPECT_TRUE(sks::bindingConflicts(codebook, wanted).empty());
  wanted.surface.normal_radius = 0.02;
  wanted.descriptor.radius = 0.08;
  EXPECT_EQ(sks::bindingConflicts(codebook, wanted),
            (std::vector<std::string>{"surface.normal_radius", "descriptor.radius"}));
}

TEST(Settings, AutomaticDescriptorTakesWhatTheCodebookHas) {
  sks::Settings codebook, wanted;
  codebook.descriptor.type = sks::DescriptorType::shot;
  EXPECT_TRUE(sks::bindingConflicts(codebook, wanted).empty());
  wanted.descriptor.type = sks::DescriptorType::cshot;
  EXPECT_EQ(sks::bindingConflicts(codebook, wanted), std::vector<std::string>{"descriptor.type"});
}

TEST(Settings, ThreadCount) {
  sks::Settings settings;
  EXPECT_GE(sks::threadCount(settings), 1);
  settings.threads = 7;
  EXPECT_EQ(sks::threadCount(settings), 7);
}
