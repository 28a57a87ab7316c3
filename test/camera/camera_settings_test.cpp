// SPDX-License-Identifier: BSD-3-Clause
#include "ros/camera/camera_settings.hpp"

#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/error.hpp>

#include "error_of.hpp"
#include "ros/own_settings.hpp"

namespace sks_detector {
namespace {

using sks::ErrorCode;
using sks::test::errorOf;
using ::testing::HasSubstr;

const std::vector<sks::SettingInfo>& infos() {
  return ownSettingInfos<CameraSettings>();
}

void set(CameraSettings& settings, const std::string& key, const std::string& text) {
  setOwnSetting(settings, *findInfo(infos(), key), text);
}

TEST(CameraSettings, TakeBackWhatTheyGive) {
  const CameraSettings defaults;
  CameraSettings copy;
  for (const sks::SettingInfo& info : infos()) {
    EXPECT_FALSE(info.help.empty()) << info.key;
    EXPECT_EQ(getOwnSetting(defaults, info.key), info.default_value) << info.key;
    EXPECT_NO_THROW(set(copy, info.key, info.default_value)) << info.key;
    EXPECT_EQ(getOwnSetting(copy, info.key), info.default_value) << info.key;
  }
}

TEST(CameraSettings, AreSetFromText) {
  CameraSettings settings;
  set(settings, "device", "1234");  // a serial number
  set(settings, "width", "320");
  set(settings, "rate", "15");
  set(settings, "color", "false");
  EXPECT_EQ(settings.device, "1234");
  EXPECT_EQ(settings.width, 320);
  EXPECT_EQ(settings.rate, 15);
  EXPECT_FALSE(settings.color);
}

TEST(CameraSettings, RefuseWrongValuesAndKeepTheOld) {
  CameraSettings settings;
  const auto refusal = [&](const std::string& key, const std::string& text) {
    return errorOf(ErrorCode::bad_usage, [&] { set(settings, key, text); });
  };
  EXPECT_EQ(refusal("width", "0"), "width = 0 is out of range: 1 to 10000 [px]");
  EXPECT_EQ(refusal("width", "320.5"), "width = 320.5: expected a whole number in 1 to 10000 [px]");
  EXPECT_EQ(refusal("rate", "nan"), "rate = nan: expected a number in 1 to 1000 [Hz]");
  EXPECT_EQ(refusal("loop", "maybe"), "loop = maybe: expected true or false");
  EXPECT_EQ(settings.width, 640);
  EXPECT_EQ(settings.rate, 30);
  EXPECT_TRUE(settings.loop);
}

TEST(CameraSettings, FindTheNearestName) {
  EXPECT_EQ(nearestKey(infos(), "widht"), "width");
  EXPECT_EQ(nearestKey(infos(), "camera.frame_idd"), "frame_id");
  EXPECT_EQ(findInfo(infos(), "widht"), nullptr);
}

TEST(CameraSettings, StandInTheDocumentation) {
  std::ifstream file(SKS_SOURCE_DIR "/docs/camera.md");
  std::stringstream documentation;
  documentation << file.rdbuf();
  for (const sks::SettingInfo& info : infos()) {
    EXPECT_THAT(documentation.str(), HasSubstr("`" + info.key + "`"));
    if (info.type == "string" && !info.default_value.empty()) {
      EXPECT_THAT(documentation.str(), HasSubstr("`" + info.default_value + "`")) << info.key;
    }
  }
}

}  // namespace
}  // namespace sks_detector
