// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/thresholds.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/settings_file.hpp>

#include "error_of.hpp"

using sks::Thresholds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace {

sks::DetectionSettings with(const std::string& thresholds) {
  sks::DetectionSettings settings;
  settings.threshold = 0.5;
  settings.thresholds = thresholds;
  return settings;
}

sks::Detection scored(const std::string& object, double score) {
  sks::Detection detection;
  detection.object = object;
  detection.score = score;
  return detection;
}

}  // namespace

TEST(Thresholds, AreOfSingleObjectsOrTheGeneralOne) {
  const Thresholds thresholds(with(" mug=0.7, a=b = 0.25 ,box=0"));
  EXPECT_EQ(thresholds.of("mug"), 0.7);
  EXPECT_EQ(thresholds.of("a=b"), 0.25) << "a name may hold the sign";
  EXPECT_EQ(thresholds.of("box"), 0);
  EXPECT_EQ(thresholds.of("other"), 0.5);
  EXPECT_THAT(Thresholds(with("")).ofSingleObjects(), IsEmpty());
  EXPECT_THAT(Thresholds(with("  ")).ofSingleObjects(), IsEmpty());
}

TEST(Thresholds, ChooseDetections) {
  sks::DetectionResult result;
  result.detections = {scored("mug", 0.9), scored("mug", 0.7), scored("mug", 0.6),
                       scored("can", 0.5), scored("box", 0.3), scored("can", 0.3)};
  std::vector<std::string> kept;
  for (const sks::Detection& detection : result.above(Thresholds(with("mug=0.7,box=0.2")))) {
    kept.push_back(detection.object);
  }
  EXPECT_THAT(kept, ElementsAre("mug", "mug", "can", "box"));
  EXPECT_EQ(result.above(0.5).size(), 4u);
}

TEST(Thresholds, RefuseWhatCannotBeUnderstood) {
  const auto refused = [](const std::string& text) {
    sks::Settings settings;
    settings.detection = with(text);
    return sks::test::errorOf(sks::ErrorCode::bad_usage, [&] { sks::validate(settings); });
  };
  for (const char* text : {"mug", "=0.5", "mug=0.7,", ",", "mug=0.7,can"}) {
    EXPECT_THAT(refused(text), HasSubstr("object=score")) << text;
  }
  for (const char* text : {"mug=", "mug=x", "mug=1.5", "mug=-0.1", "mug=nan"}) {
    EXPECT_THAT(refused(text), HasSubstr("a score of 0 to 1")) << text;
  }
  EXPECT_THAT(refused("mug=0.7,mug=0.8"), HasSubstr("has a threshold already"));
}

TEST(Thresholds, UnknownNamesAreWarnedOf) {
  EXPECT_THAT(sks::thresholdWarnings(with("mugg=0.7,box=0.4"), {"mug", "box"}),
              ElementsAre("detection.thresholds: 'mugg' is not in the codebook; did you mean 'mug'?"));
  EXPECT_THAT(sks::thresholdWarnings(with("box=0.4"), {"mug", "box"}), IsEmpty());
}

TEST(Thresholds, SurviveSettingsFiles) {
  for (const char* text : {"", "mug=0.7,box=0.4", "a \"b\\c: #d=0.1", "tab\t=0.2"}) {
    sks::Settings settings, read;
    settings.detection.thresholds = text;
    sks::parseSettings(sks::settingsToYaml(settings, true), "test", read);
    EXPECT_EQ(read.detection.thresholds, text);
  }
}
