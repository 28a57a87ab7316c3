// SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drawing/palette.hpp"
#include "rviz/async_calls.hpp"
#include "rviz/object_colors.hpp"
#include "rviz/shown_detections.hpp"
#include "rviz/stream_watch.hpp"

namespace sks_detector {
namespace {

using ::testing::HasSubstr;

Ogre::ColourValue paletteAt(std::size_t index) {
  const sks::Rgb color = sks::paletteColor(index);
  return Ogre::ColourValue(float(color.r) / 255, float(color.g) / 255, float(color.b) / 255);
}

Detection valid(const std::string& object) {
  Detection detection;
  detection.object = object;
  detection.score = 0.9F;
  detection.pose.pose.orientation.w = detection.box_center.orientation.w = 1;
  return detection;
}

TEST(ShownDetections, KeysStayWithTheThing) {
  DetectionArray array;
  array.detections = {valid("cup"), valid("mug"), valid("cup")};
  array.detections[1].id = 7;
  const ShownDetections shown = chooseShown(array, 0, 10);
  ASSERT_EQ(shown.shown.size(), 3U);
  EXPECT_EQ(shown.shown[0].key, "0 of object cup");
  EXPECT_EQ(shown.shown[1].key, "0 of id 7");
  EXPECT_EQ(shown.shown[2].key, "1 of object cup");
  EXPECT_EQ(shown.problem, "");
}

TEST(ShownDetections, LeavesOutWhatSinglePrecisionCannotDraw) {
  DetectionArray array;
  array.detections = {valid("far"), valid("inside out"), valid("nan")};
  array.detections[0].box_center.position.z = -1e30;
  array.detections[1].box_size.x = -0.1;
  array.detections[2].score = std::numeric_limits<float>::quiet_NaN();
  const ShownDetections shown = chooseShown(array, 0, 10);
  EXPECT_EQ(shown.shown.size(), 0U);
  EXPECT_EQ(shown.unusable, 3U);
  EXPECT_THAT(shown.problem, HasSubstr("detection 0 ('far'): a length of 1e+30 m"));
}

TEST(ObjectColors, AreThoseOfTheCodebookOrOfTheOrderOfAppearance) {
  ObjectColors colors;
  EXPECT_EQ(colors.color("mug"), paletteAt(0));
  EXPECT_EQ(colors.color("cup"), paletteAt(1));
  EXPECT_EQ(colors.color("mug"), paletteAt(0));
  EXPECT_TRUE(colors.setCodebook({"cup", "mug"}));
  EXPECT_FALSE(colors.setCodebook({"cup", "mug"}));
  EXPECT_EQ(colors.color("mug"), paletteAt(1));
  EXPECT_EQ(colors.color("stranger"), paletteAt(2));
  EXPECT_EQ(colors.color("another"), paletteAt(2));
  colors.forget();
  EXPECT_EQ(colors.color("stranger"), paletteAt(0));
}

TEST(ObjectColors, OfScoresGoFromRedToGreen) {
  EXPECT_EQ(scoreColor(0), Ogre::ColourValue(1, 0, 0));
  EXPECT_EQ(scoreColor(0.5), Ogre::ColourValue(1, 1, 0));
  EXPECT_EQ(scoreColor(7), Ogre::ColourValue(0, 1, 0));
  EXPECT_EQ(scoreColor(std::numeric_limits<double>::quiet_NaN()), Ogre::ColourValue(1, 0, 0));
}

TEST(StreamWatch, TellsRateAndMedians) {
  StreamWatch watch;
  const StreamWatch::Clock::time_point start;
  EXPECT_EQ(watch.describe(start), "no result in the last 5 s");
  for (int i = 0; i < 9; ++i) watch.add(start + std::chrono::milliseconds(250 * i), i == 4 ? 30 : 0.31, 0.24);
  EXPECT_EQ(watch.describe(start + std::chrono::seconds(2)),
            "4.0 results/s, 310 ms from camera to result, 240 ms of processing");
  EXPECT_EQ(watch.describe(start + std::chrono::seconds(8)), "no result in the last 5 s");
  watch.add(start + std::chrono::seconds(9), -1e9, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(watch.describe(start + std::chrono::seconds(9)), "1 result in the last 5 s, stamps of another clock");
}

TEST(AsyncCalls, SaysInWordsThatACallWasLate) {
  EXPECT_THAT(lateText("/detector/train", std::chrono::seconds(10)),
              HasSubstr("/detector/train did not answer within 10 s"));
}

}  // namespace
}  // namespace sks_detector
