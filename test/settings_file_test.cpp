// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/settings_file.hpp>

#include <sstream>

#include <gtest/gtest.h>

#include "error_of.hpp"
#include "io/file.hpp"
#include "temporary_folder.hpp"

namespace {

using sks::ErrorCode;
using sks::test::errorOf;

std::string parseError(const std::string& yaml, ErrorCode code = ErrorCode::bad_usage) {
  return errorOf(code, [&] {
    sks::Settings settings;
    sks::parseSettings(yaml, "c.yaml", settings);
  });
}

}  // namespace

TEST(SettingsFile, OverlaysWhatItNames) {
  sks::Settings settings;
  settings.ransac.seed = 9;
  sks::parseSettings("keypoints: {discard: 0.75, detector: iss}\nsanitize:\n  crop: true\nthreads: 2\n", "c", settings);
  EXPECT_EQ(settings.keypoints.discard, 0.75);
  EXPECT_EQ(settings.keypoints.detector, sks::KeypointDetector::iss);
  EXPECT_TRUE(settings.sanitize.crop);
  EXPECT_EQ(settings.threads, 2);
  EXPECT_EQ(settings.ransac.seed, 9);
}

TEST(SettingsFile, EmptyFilesAndGroupsSetNothing) {
  for (const char* yaml : {"", "# only a comment\n", "---\n", "keypoints:\n", "keypoints: {}\n", "{}"}) {
    sks::Settings settings;
    EXPECT_NO_THROW(sks::parseSettings(yaml, "c.yaml", settings)) << yaml;
    EXPECT_EQ(sks::settingsToYaml(settings), sks::settingsToYaml(sks::Settings())) << yaml;
  }
}

TEST(SettingsFile, DottedKeysAreKeysToo) {
  sks::Settings settings;
  sks::parseSettings("keypoints.discard: 0.25\n", "c.yaml", settings);
  EXPECT_EQ(settings.keypoints.discard, 0.25);
}

TEST(SettingsFile, UnknownKeysNameFileLineAndNearest) {
  EXPECT_EQ(parseError("threads: 1\nkeypoints:\n  discrad: 0.5\n"),
            "c.yaml:3: unknown setting 'keypoints.discrad': did you mean 'keypoints.discard'?");
  EXPECT_EQ(parseError("keypoint: {discard: 0.5}\n"),
            "c.yaml:1: unknown setting 'keypoint.discard': did you mean 'keypoints.discard'?");
  EXPECT_EQ(parseError("thread: 1\n"), "c.yaml:1: unknown setting 'thread': did you mean 'threads'?");
}

TEST(SettingsFile, BadValuesNameFileLineAndKey) {
  EXPECT_EQ(parseError("keypoints: {discard: 1.5}"), "c.yaml:1: keypoints.discard = 1.5 is out of range: 0 to 0.99");
  EXPECT_EQ(parseError("\n\ndescriptor:\n  radius: 5 cm\n"),
            "c.yaml:4: descriptor.radius = 5 cm: expected a number in 0.002 to 1 [m]");
  EXPECT_EQ(parseError("keypoints: {discard: }"),
            "c.yaml:1: keypoints.discard = nothing: expected a number in 0 to 0.99");
  EXPECT_EQ(parseError("keypoints: {discard: [0.5]}"),
            "c.yaml:1: keypoints.discard = a list: expected a number in 0 to 0.99");
  EXPECT_EQ(parseError("threads: {n: 2}"), "c.yaml:1: unknown setting 'threads.n': did you mean 'threads'?");
  EXPECT_EQ(parseError("keypoints: 0.5\n"), "c.yaml:1: 'keypoints' is a group: give a map of its settings");
}

TEST(SettingsFile, RepeatedKeysAreRefused) {
  EXPECT_EQ(parseError("threads: 1\nthreads: 2\n"), "c.yaml:2: 'threads' is set twice; keep one");
  EXPECT_EQ(parseError("keypoints: {discard: 0.5}\nkeypoints.discard: 0.25\n"),
            "c.yaml:2: 'keypoints.discard' is set twice; keep one");
}

TEST(SettingsFile, OtherThanOneMapIsRefused) {
  EXPECT_EQ(parseError("[1, 2]"), "c.yaml:1: settings must be a map, e.g. keypoints: {discard: 0.5}");
  EXPECT_EQ(parseError("discard"), "c.yaml:1: settings must be a map, e.g. keypoints: {discard: 0.5}");
  EXPECT_EQ(parseError("{threads: 1}\n---\n{threads: 2}\n", ErrorCode::bad_file),
            "c.yaml:2: a second document in one file; keep one");
  EXPECT_EQ(parseError("? [a]\n: 1\n"), "c.yaml:1: a key must be plain text");
}

TEST(SettingsFile, ForeignFilesAreNamed) {
  const std::string message = parseError("threads: 1\nkeypoints: [\n", ErrorCode::bad_file);
  EXPECT_EQ(message.rfind("c.yaml:3: not a YAML file: ", 0), 0u) << message;
  const sks::test::TemporaryFolder folder;
  sks::Settings settings;
  EXPECT_EQ(errorOf(ErrorCode::bad_file, [&] { sks::loadSettings(folder.path("none.yaml"), settings); }),
            "cannot read '" + folder.path("none.yaml") + "': No such file or directory");
  sks::writeFileAtomically(folder.path("c.yaml"), "threads: 999\n");
  EXPECT_EQ(errorOf(ErrorCode::bad_usage, [&] { sks::loadSettings(folder.path("c.yaml"), settings); }),
            folder.path("c.yaml") + ":1: threads = 999 is out of range: 0 to 256");
}

/// For YAML::LoadAll() these never end, while memory fills.
TEST(SettingsFile, BracketsWithoutAMatchAreRefused) {
  for (const char* yaml :
       {"{threads: 1}}\n", "{keypoints: {discard: 0.5}, voting.b}, voting.a,}\n", "},\n", ",,,a: {b\nc"}) {
    EXPECT_EQ(parseError(yaml, ErrorCode::bad_file).rfind("c.yaml:", 0), 0u) << yaml;
  }
}

TEST(SettingsFile, DeepNestingIsRefusedBeforeItIsParsed) {
  const std::string depth(100000, '['), message = "it is nested too deeply";
  EXPECT_EQ(parseError("threads: 1\n" + depth, ErrorCode::bad_file), "c.yaml:2: not a YAML file: " + message);
  EXPECT_EQ(parseError(std::string(100000, '{'), ErrorCode::bad_file), "c.yaml:1: not a YAML file: " + message);
  std::string blocks;
  for (int i = 0; i < 100000; ++i) blocks += "- ";
  EXPECT_EQ(parseError(blocks, ErrorCode::bad_file), "c.yaml:1: not a YAML file: " + message);
}

TEST(SettingsFile, RefusedFileChangesNothing) {
  sks::Settings settings;
  EXPECT_THROW(sks::parseSettings("threads: 2\nnone: 1\n", "c.yaml", settings), sks::Error);
  EXPECT_EQ(settings.threads, 0);
}

TEST(SettingsFile, EverySettingSurvivesTheRoundTrip) {
  sks::Settings settings;
  settings.keypoints.discard = 1.0 / 3;
  settings.descriptor.type = sks::DescriptorType::cshot;
  settings.sanitize.crop = true;
  settings.sanitize.crop_min_x = -0.125;
  settings.threads = 5;
  for (const bool comments : {false, true}) {
    const std::string yaml = sks::settingsToYaml(settings, comments);
    sks::Settings back;
    sks::parseSettings(yaml, "c.yaml", back);
    for (const sks::SettingInfo& info : sks::settingInfos()) {
      EXPECT_EQ(sks::getSetting(back, info.key), sks::getSetting(settings, info.key)) << info.key;
    }
    EXPECT_EQ(sks::settingsToYaml(back, comments), yaml);
  }
}

TEST(SettingsFile, CommentsTellHelpUnitRangeDefaultAndBinding) {
  const std::string text = sks::settingsToYaml(sks::Settings(), true);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
  EXPECT_NE(text.find("  # drop points at exactly the place of an earlier one (true, false; default true)\n"
                      "  remove_duplicates: true\n"),
            std::string::npos);
  EXPECT_NE(text.find("reference frame (0.002 to 1 [m]; default 0.05;"), std::string::npos);
  EXPECT_NE(text.find(" codebook)\n  radius: 0.05\n"), std::string::npos);
}
