// SPDX-License-Identifier: BSD-3-Clause
#include "ros/configuration.hpp"

#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/error.hpp>

#include "error_of.hpp"

namespace sks_detector {
namespace {

using sks::ErrorCode;
using sks::test::errorOf;
using ::testing::AllOf;
using ::testing::HasSubstr;

void setParameter(Configuration& configuration, const std::string& key, const std::string& text) {
  sks::SettingsOverlay(bound(configuration)).set(key, text);
}

TEST(Configuration, HasEachParameterOnceWithHelpAndUnit) {
  std::set<std::string> keys;
  for (const sks::SettingInfo& info : parameterInfos()) {
    EXPECT_TRUE(keys.insert(info.key).second) << info.key;
    EXPECT_FALSE(info.help.empty()) << info.key;
  }
  EXPECT_EQ(keys.count("target_frame"), 1U);
  EXPECT_EQ(keys.count("keypoints.discard"), 1U);
  EXPECT_EQ(nodeTable().at("tf_timeout").unit, "s");
  EXPECT_EQ(nodeTable().find("nothing"), nullptr);
}

TEST(Configuration, TakesBackWhatItGives) {
  const Configuration defaults;
  Configuration copy;
  for (const sks::SettingInfo& info : parameterInfos()) {
    const std::string text = getParameter(defaults, info.key);
    EXPECT_NO_THROW(setParameter(copy, info.key, text)) << info.key;
    EXPECT_EQ(getParameter(copy, info.key), text) << info.key;
  }
}

TEST(Configuration, SetsValuesOfNodeAndDetector) {
  Configuration configuration;
  setParameter(configuration, "target_frame", "base_link");
  setParameter(configuration, "max_input_age", "0.5");
  setParameter(configuration, "always_on", "true");
  setParameter(configuration, "keypoints.discard", "0.25");
  EXPECT_EQ(configuration.node.target_frame, "base_link");
  EXPECT_EQ(configuration.node.max_input_age, 0.5);
  EXPECT_TRUE(configuration.node.always_on);
  EXPECT_EQ(configuration.detector.keypoints.discard, 0.25);
}

TEST(Configuration, RefusesWrongValuesAndKeepsTheOld) {
  Configuration configuration;
  const auto refusal = [&](const std::string& key, const std::string& text) {
    return errorOf(ErrorCode::bad_usage, [&] { setParameter(configuration, key, text); });
  };
  EXPECT_THAT(refusal("tf_timeout", "61"), AllOf(HasSubstr("tf_timeout = 61"), HasSubstr("0 to 60 [s]")));
  EXPECT_THAT(refusal("tf_timeout", "nan"), HasSubstr("tf_timeout"));
  EXPECT_THAT(refusal("tf_timeout", "soon"), HasSubstr("expected a number"));
  EXPECT_THAT(refusal("always_on", "perhaps"), HasSubstr("expected true or false"));
  EXPECT_THAT(refusal("keypoints.discard", "2"), HasSubstr("keypoints.discard"));
  EXPECT_THAT(refusal("target_farme", "x"), HasSubstr("did you mean 'target_frame'?"));
  for (const sks::SettingInfo& info : parameterInfos()) {
    EXPECT_EQ(getParameter(configuration, info.key), getParameter(Configuration(), info.key));
  }
}

TEST(Configuration, FindsTheNearestNameAlsoInAnotherGroup) {
  Configuration configuration;
  const sks::SettingsOverlay overlay(bound(configuration));
  EXPECT_EQ(overlay.nearest("keypoints.discrad"), "keypoints.discard");
  EXPECT_EQ(overlay.nearest("descriptor.grid_size"), "keypoints.grid_size");
  EXPECT_EQ(overlay.nearest("always_one"), "always_on");
}

TEST(Configuration, KnowsWhatCanBeChangedWhileTheNodeRuns) {
  for (const char* fixed : {"codebook", "codebook_directory", "dataset_directory", "service_timeout"}) {
    EXPECT_FALSE(isChangeable(fixed)) << fixed;
  }
  EXPECT_TRUE(isChangeable("target_frame"));
  EXPECT_TRUE(isChangeable("detection.threshold"));
}

}  // namespace
}  // namespace sks_detector
