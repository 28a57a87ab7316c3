// SPDX-License-Identifier: BSD-3-Clause
#include "ros/camera/camera_parameters.hpp"

#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/error.hpp>

#include "core/settings/settings_overlay.hpp"
#include "error_of.hpp"
#include "ros/parameter_trees.hpp"

namespace sks_detector {
namespace {

using sks::ErrorCode;
using sks::test::errorOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

const std::vector<sks::SettingInfo>& infos() {
  return cameraTable().infos();
}

void set(CameraSettings& settings, const std::string& key, const std::string& text) {
  cameraTable().set(settings, key, text);
}

TEST(CameraSettings, TakeBackWhatTheyGive) {
  const CameraSettings defaults;
  CameraSettings copy;
  for (const sks::SettingInfo& info : infos()) {
    EXPECT_FALSE(info.help.empty()) << info.key;
    EXPECT_EQ(cameraTable().get(defaults, info.key), info.default_value) << info.key;
    EXPECT_NO_THROW(set(copy, info.key, info.default_value)) << info.key;
    EXPECT_EQ(cameraTable().get(copy, info.key), info.default_value) << info.key;
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

std::vector<std::string> problemsOf(const XmlRpc::XmlRpcValue& tree) {
  return readCameraParameters(tree, "/camera").problems;
}

TEST(CameraParameters, AreRead) {
  XmlRpc::XmlRpcValue tree;
  tree["width"] = 320;
  tree["device"] = 1234;
  const CameraParameters parameters = readCameraParameters(tree, "/camera");
  EXPECT_THAT(parameters.problems, IsEmpty());
  EXPECT_EQ(parameters.settings.width, 320);
  EXPECT_EQ(parameters.settings.device, "1234");
}

TEST(CameraParameters, RefuseRepeatedKeys) {
  CameraSettings settings;
  sks::SettingsOverlay overlay({cameraTable().bind(settings)});
  overlay.set("width", "320");  // on the parameter server a name without groups stands once
  EXPECT_EQ(errorOf(ErrorCode::bad_usage, [&] { overlay.set("width", "320"); }), "'width' is set twice; keep one");
}

TEST(CameraParameters, IgnoreDeepNests) {
  EXPECT_THAT(problemsOf(test::deepNest(100)),
              ElementsAre("parameter " + test::deepName("/camera") + " is ignored: it is nested too deeply"));
}

TEST(CameraParameters, RefuseWrongTypes) {
  XmlRpc::XmlRpcValue tree;
  tree["device"][0] = "1234";
  tree["width"] = "wide";
  tree["loop"]["x"] = 1;
  EXPECT_THAT(
      problemsOf(tree),
      UnorderedElementsAre(
          "parameter /camera/device: device = a list: expected text; the default is used",
          "parameter /camera/width: width = wide: expected a whole number in 1 to 10000 [px]; the default is used",
          "parameter /camera/loop: loop = a map: expected true or false; the default is used"));
}

TEST(CameraParameters, RefuseValuesOutOfRange) {
  XmlRpc::XmlRpcValue tree;
  tree["rate"] = -5;
  EXPECT_THAT(problemsOf(tree), ElementsAre("parameter /camera/rate: rate = -5 is out of range: 1 to 1000 [Hz]; the "
                                            "default is used"));
}

TEST(CameraParameters, WarnAboutUnknownNames) {
  XmlRpc::XmlRpcValue tree;
  tree["widht"] = 320;
  tree["camera"]["frame_idd"] = "camera";
  EXPECT_THAT(problemsOf(tree),
              UnorderedElementsAre("unknown parameter /camera/widht is ignored: did you mean /camera/width?",
                                   "unknown parameter /camera/camera/frame_idd is ignored: did you mean "
                                   "/camera/frame_id?"));
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
