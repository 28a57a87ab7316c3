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
  EXPECT_EQ(parseError("keypoints:\n  discard: 0.5\n  discard: 0.5\n"),
            "c.yaml:3: 'keypoints.discard' is set twice; keep one");
  EXPECT_EQ(parseError("keypoints: {discard: 0.5}\nkeypoints: {grid_size: 0.03}\n"),
            "c.yaml:2: 'keypoints' is set twice; keep one");
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
  EXPECT_NE(
      text.find("  # drop each point that has exactly the position of an earlier one (true, false; default true)\n"
                "  remove_duplicates: true\n"),
      std::string::npos);
  const std::size_t radius = text.find("\n  radius: 0.05\n");
  ASSERT_NE(radius, std::string::npos);
  const std::string above = text.substr(radius - 120, 120);
  EXPECT_NE(above.find("(0.002 to 1 [m]; default 0.05;"), std::string::npos) << above;
  EXPECT_NE(above.find(" codebook)"), std::string::npos) << above;
}

TEST(SettingsFile, OldNamesStillWorkAndAreWarnedAbout) {
  sks::Settings settings;
  std::vector<std::string> warnings;
  const char* old = "verification:\n  candidates: 0\n  ambiguity: 1.5\n  skip_planes: false\n";
  sks::parseSettings(old, "c.yaml", settings, &warnings);
  EXPECT_EQ(settings.detection.hypotheses, sks::Hypotheses::hough);
  EXPECT_EQ(settings.verification.candidates, sks::Settings().verification.candidates);
  EXPECT_EQ(settings.matching.ambiguity, 1.5);
  EXPECT_FALSE(settings.keypoints.skip_planes);
  EXPECT_EQ(warnings,
            (std::vector<std::string>{
                "c.yaml:2: 'verification.candidates = 0' is now called 'detection.hypotheses = hough'; the old name "
                "still works",
                "c.yaml:3: 'verification.ambiguity' is now called 'matching.ambiguity'; the old name still works",
                "c.yaml:4: 'verification.skip_planes' is now called 'keypoints.skip_planes'; the old name still works",
            }));
  sks::Settings quiet;
  sks::parseSettings(old, "c.yaml", quiet);
  EXPECT_EQ(sks::settingsToYaml(quiet), sks::settingsToYaml(settings));

  warnings.clear();
  sks::parseSettings("verification.candidates: 7\n", "c.yaml", quiet, &warnings);
  EXPECT_EQ(quiet.verification.candidates, 7);
  EXPECT_TRUE(warnings.empty()) << warnings.front();
}

TEST(SettingsFile, OldAndNewNameAtOnceAreRefused) {
  EXPECT_EQ(parseError("matching: {ambiguity: 1.2}\nverification:\n  ambiguity: 1.2\n"),
            "c.yaml:3: 'matching.ambiguity' is set twice, also as 'verification.ambiguity'; keep one");
  EXPECT_EQ(parseError("verification:\n  skip_planes: true\nkeypoints:\n  skip_planes: true\n"),
            "c.yaml:4: 'keypoints.skip_planes' is set twice, also as 'verification.skip_planes'; keep one");
  EXPECT_EQ(parseError("verification:\n  candidates: 0\ndetection: {hypotheses: verified}\n"),
            "c.yaml:3: 'detection.hypotheses' is set twice, also as 'verification.candidates = 0'; keep one");
  EXPECT_EQ(parseError("verification: {candidates: 1001}"),
            "c.yaml:1: verification.candidates = 1001 is out of range: 1 to 1000");
}
