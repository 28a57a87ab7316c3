// SPDX-License-Identifier: BSD-3-Clause
#ifdef SKS_EXECUTABLE  // they come with the command line

#include "baselines/method_settings.hpp"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.hpp"
#include "io/file.hpp"
#include "temporary_folder.hpp"

namespace sks::baselines {
namespace {

using test::errorOf;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(MethodSettings, AreSetFromTextAndReadBack) {
  MethodSettings settings;
  setMethodSetting(settings, "tombari.bin_size", "0.05");
  setMethodSetting(settings, "chen.consensus", "7");
  setMethodSetting(settings, "seib.balance", "false");
  EXPECT_EQ(settings.tombari.bin_size, 0.05);
  EXPECT_EQ(getMethodSetting(settings, "chen.consensus"), "7");
  EXPECT_EQ(getMethodSetting(settings, "seib.balance"), "false");
  for (const SettingInfo& info : methodSettingInfos()) {
    EXPECT_EQ(getMethodSetting(MethodSettings(), info.key), info.default_value) << info.key;
    EXPECT_FALSE(info.help.empty()) << info.key;
    EXPECT_NO_THROW(setMethodSetting(settings, info.key, info.default_value)) << info.key;
  }
}

TEST(MethodSettings, SayWhatIsWrong) {
  MethodSettings settings;
  const auto set = [&](const std::string& key, const std::string& text) {
    return errorOf(ErrorCode::bad_usage, [&] { setMethodSetting(settings, key, text); });
  };
  EXPECT_THAT(set("tombari.binsize", "1"), HasSubstr("did you mean 'tombari.bin_size'?"));
  EXPECT_THAT(set("tombari.bin_size", "2"), HasSubstr("tombari.bin_size = 2: expected a number in 0.001 to 1 [m]"));
  EXPECT_THAT(set("chen.consensus", "3.5"), HasSubstr("expected a whole number in 3 to 10000"));
  EXPECT_THAT(set("tombari.weigh", "maybe"), HasSubstr("expected true, false"));
  EXPECT_TRUE(isMethodSetting("chen"));
  EXPECT_TRUE(isMethodSetting("chen.anything"));
  EXPECT_FALSE(isMethodSetting("keypoints.discard"));
}

class MethodSettingsFile : public ::testing::Test {
protected:
  void load(const std::string& text) {
    writeFileAtomically(path_, text);
    loadMethodSettings(path_, settings_, own_);
  }

  test::TemporaryFolder folder_;
  std::string path_ = folder_.path("preset.yaml");
  Settings settings_;
  MethodSettings own_;
};

TEST_F(MethodSettingsFile, HoldsSettingsOfTheDetectorToo) {
  load("# a preset\nchen: {consensus: 9}\nkeypoints:\n  discard: 0.25\ntombari:\n  bin_size: 0.07\n\n  weigh: true\n");
  EXPECT_EQ(own_.chen.consensus, 9);
  EXPECT_EQ(own_.tombari.bin_size, 0.07);
  EXPECT_TRUE(own_.tombari.weigh);
  EXPECT_EQ(settings_.keypoints.discard, 0.25);
}

TEST_F(MethodSettingsFile, NamesFileAndLineOfMistakes) {
  EXPECT_THAT(errorOf(ErrorCode::bad_usage, [&] { load("tombari:\n  bin_size: 5\n"); }),
              AllOf(HasSubstr("preset.yaml:2: "), HasSubstr("tombari.bin_size = 5")));
  EXPECT_THAT(errorOf(ErrorCode::bad_usage, [&] { load("tombari:\n  bin_size: 0.05\nkeypoints:\n  discrad: 1\n"); }),
              AllOf(HasSubstr("preset.yaml:4: "), HasSubstr("keypoints.discard")));
  EXPECT_THAT(errorOf(ErrorCode::bad_usage, [&] { load("chen: 5\n"); }), HasSubstr("preset.yaml:1: 'chen' is a group"));
  EXPECT_THAT(errorOf(ErrorCode::bad_file, [&] { load("chen: [\n"); }), HasSubstr("not a YAML file"));
  EXPECT_EQ(own_.tombari.bin_size, MethodSettings().tombari.bin_size);  // all or nothing
}

TEST(MethodPresets, LoadAndAreValid) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SKS_SOURCE_DIR "/config/methods")) {
    Settings settings;
    MethodSettings own;
    ++files;
    EXPECT_NO_THROW(loadMethodSettings(entry.path().string(), settings, own)) << entry.path();
    EXPECT_NO_THROW(validate(settings)) << entry.path();
    EXPECT_EQ(settings.keypoints.discard, 0) << entry.path();  // selection is what is compared
  }
  EXPECT_EQ(files, 9);
}

}  // namespace
}  // namespace sks::baselines

#endif
