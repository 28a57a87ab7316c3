// SPDX-License-Identifier: BSD-3-Clause
#include "ros/detection_frame.hpp"

#include <gtest/gtest.h>

#include "error_of.hpp"

namespace sks_detector {
namespace {

std::string frame(const std::string& prefix, const std::string& pattern, const std::string& object, int number) {
  NodeSettings settings;
  settings.tf_prefix = prefix;
  settings.tf_frame = pattern;
  return detectionFrame(settings, object, number);
}

}  // namespace

TEST(DetectionFrame, IsTheNameOfTheObjectByDefault) {
  EXPECT_EQ(detectionFrame(NodeSettings(), "mug", 1), "mug");
  EXPECT_EQ(detectionFrame(NodeSettings(), "mug", 2), "mug_2");
}

TEST(DetectionFrame, FollowsPrefixAndPattern) {
  EXPECT_EQ(frame("left", "{object}", "mug", 2), "left/mug_2");
  EXPECT_EQ(frame("/left", "{object}_{number}", "mug", 1), "left/mug_1");
  EXPECT_EQ(frame("", "/seen/{number}/{object}", "{number}", 3), "seen/3/{number}");
}

TEST(DetectionFrame, APatternMustTellObjectsApart) {
  const auto error = [](const std::string& pattern) {
    return sks::test::errorOf(sks::ErrorCode::bad_usage, [&] { checkFramePattern(pattern); });
  };
  EXPECT_NO_THROW(checkFramePattern("{object}"));
  EXPECT_EQ(error("thing"), "tf_frame = 'thing' gives all objects one frame: it must hold {object}");
  EXPECT_EQ(error("{object}{index}"),
            "tf_frame = '{object}{index}' has braces around something else than {object} or {number}");
}

}  // namespace sks_detector
