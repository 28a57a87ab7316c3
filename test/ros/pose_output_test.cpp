// SPDX-License-Identifier: BSD-3-Clause
#include "ros/pose_output.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sks_detector {

TEST(PoseOutput, NamesOfTopicsAreValidAndDiffer) {
  EXPECT_THAT(topicNames({"mug", "tea pot", "tea_pot", "3/4 \xC3\xBC", "tea pot"}),
              testing::ElementsAre("mug", "tea_pot", "tea_pot_2", "3_4___", "tea_pot_3"));
  EXPECT_TRUE(topicNames({}).empty());
}

}  // namespace sks_detector
