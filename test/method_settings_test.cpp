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
using ::testing::HasSubstr;

TEST(MethodSettings, AreSetFromTextAndReadBack) {
  MethodSettings settings;
  methodTable().set(settings, "tombari.bin_size", "0.05");
  methodTable().set(settings, "chen.consensus", "7");
  methodTable().set(settings, "seib.balance", "false");
  EXPECT_EQ(settings.tombari.bin_size, 0.05);
  EXPECT_EQ(methodTable().get(settings, "chen.consensus"), "7");
  EXPECT_EQ(methodTable().get(settings, "seib.balance"), "false");
  for (const SettingInfo& info : methodTable().infos()) {
    EXPECT_EQ(methodTable().get(MethodSettings(), info.key), info.default_value) << info.key;
    EXPECT_FALSE(info.help.empty()) << info.key;
    EXPECT_NO_THROW(methodTable().set(settings, info.key, info.default_value)) << info.key;
  }
}

TEST(MethodSettings, SayWhatIsWrong) {
  MethodSettings settings;
  const auto set = [&](const std::string& key, const std::string& text) {
    return errorOf(ErrorCode::bad_usage, [&] { methodTable().set(settings, key, text); });
  };
  EXPECT_EQ(set("tombari.binsize", "1"), "unknown setting 'tombari.binsize': did you mean 'tombari.bin_size'?");
  EXPECT_EQ(set("tombari.bin_size", "2"), "tombari.bin_size = 2 is out of range: 0.001 to 1 [m]");
  EXPECT_EQ(set("tombari.bin_size", "nan"), "tombari.bin_size = nan: expected a number in 0.001 to 1 [m]");
  EXPECT_EQ(set("chen.consensus", "3.5"), "chen.consensus = 3.5: expected a whole number in 3 to 10000");
  EXPECT_EQ(set("tombari.weigh", "maybe"), "tombari.weigh = maybe: expected true or false");
}

class MethodSettingsFile : public ::testing::Test {
protected:
  void load(const std::string& text) {
    writeFileAtomically(path_, text);
    loadMethodSettings(path_, settings_, own_, &warnings_);
  }
  /// What is said about a file, without its path.
  std::string loadError(const std::string& text, ErrorCode code = ErrorCode::bad_usage) {
    const std::string message = errorOf(code, [&] { load(text); });
    EXPECT_EQ(message.rfind(path_ + ":", 0), 0u) << message;
    return message.substr(path_.size() + 1);
  }

  test::TemporaryFolder folder_;
  std::string path_ = folder_.path("preset.yaml");
  Settings settings_;
  MethodSettings own_;
  std::vector<std::string> warnings_;
};

TEST_F(MethodSettingsFile, HoldsSettingsOfTheDetectorToo) {
  load("# a preset\nchen: {consensus: 9}\nkeypoints:\n  discard: 0.25\ntombari:\n  bin_size: 0.07\n\n  weigh: true\n");
  EXPECT_EQ(own_.chen.consensus, 9);
  EXPECT_EQ(own_.tombari.bin_size, 0.07);
  EXPECT_TRUE(own_.tombari.weigh);
  EXPECT_EQ(settings_.keypoints.discard, 0.25);
}

TEST_F(MethodSettingsFile, NamesFileLineAndKeyOfMistakes) {
  EXPECT_EQ(loadError("tombari:\n  bin_size: 5\n"), "2: tombari.bin_size = 5 is out of range: 0.001 to 1 [m]");
  EXPECT_EQ(loadError("tombari: {bin_size: wide}"), "1: tombari.bin_size = wide: expected a number in 0.001 to 1 [m]");
  EXPECT_EQ(loadError("tombari: {bin_size: [0.1]}"),
            "1: tombari.bin_size = a list: expected a number in 0.001 to 1 [m]");
  EXPECT_EQ(loadError("tombari: {weigh: {a: 1}}"), "1: tombari.weigh = a map: expected true or false");
  EXPECT_EQ(loadError("tombari:\n  bin_szie: 0.05\n"),
            "2: unknown setting 'tombari.bin_szie': did you mean 'tombari.bin_size'?");
  EXPECT_EQ(loadError("tombari:\n  bin_size: 0.05\nkeypoints:\n  discrad: 1\n"),
            "4: unknown setting 'keypoints.discrad': did you mean 'keypoints.discard'?");
  EXPECT_EQ(loadError("chen: 5\n"), "1: 'chen' is a group: give a map of its settings");
  EXPECT_THAT(loadError("chen: [\n", ErrorCode::bad_file), HasSubstr("not a YAML file"));
  EXPECT_EQ(own_.tombari.bin_size, MethodSettings().tombari.bin_size);  // all or nothing
}

TEST_F(MethodSettingsFile, RefusesRepeatedKeys) {
  EXPECT_EQ(loadError("tombari: {bin_size: 0.03, bin_size: 0.05}"), "1: 'tombari.bin_size' is set twice; keep one");
  EXPECT_EQ(loadError("tombari: {bin_size: 0.03}\ntombari: {votes: 2}"), "2: 'tombari' is set twice; keep one");
  EXPECT_EQ(loadError("tombari: {bin_size: 0.03}\ntombari.bin_size: 0.03"),
            "2: 'tombari.bin_size' is set twice; keep one");
}

TEST_F(MethodSettingsFile, RefusesDeepNestsBeforeTheyAreParsed) {
  EXPECT_EQ(loadError("tombari:\n  bin_size: " + std::string(100000, '['), ErrorCode::bad_file),
            "2: not a YAML file: it is nested too deeply");
}

TEST_F(MethodSettingsFile, WarnsAboutOldNames) {
  load("seib: {balance: false}\nverification: {ambiguity: 1.2}\n");
  EXPECT_FALSE(own_.seib.balance);
  EXPECT_EQ(settings_.matching.ambiguity, 1.2);
  EXPECT_EQ(warnings_,
            std::vector<std::string>{
                path_ + ":2: 'verification.ambiguity' is now called 'matching.ambiguity'; the old name still works"});
}

TEST(MethodPresets, LoadAndAreValid) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SKS_SOURCE_DIR "/config/methods")) {
    Settings settings;
    MethodSettings own;
    ++files;
    std::vector<std::string> warnings;
    EXPECT_NO_THROW(loadMethodSettings(entry.path().string(), settings, own, &warnings)) << entry.path();
    EXPECT_TRUE(warnings.empty()) << warnings.front();
    EXPECT_NO_THROW(validate(settings)) << entry.path();
    EXPECT_EQ(settings.keypoints.discard, 0) << entry.path();  // selection is what is compared
  }
  EXPECT_EQ(files, 9);
}

}  // namespace
}  // namespace sks::baselines

#endif
