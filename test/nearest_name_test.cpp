// SPDX-License-Identifier: BSD-3-Clause
#include "core/settings/nearest_name.hpp"

#include <gtest/gtest.h>

namespace sks {
namespace {

TEST(NearestName, IsTheOneWithTheFewestEdits) {
  EXPECT_EQ(nearestName("scene", {"name", "scenes", "tests"}), "scenes");
  EXPECT_EQ(nearestName("clodu", {"object", "kind", "cloud"}), "cloud");
  EXPECT_EQ(nearestName("sim", {"settings", "simulate"}), "simulate");
  EXPECT_EQ(nearestName("x", {}), "");
}

TEST(NearestName, IsNoneWhereNothingIsNear) {
  EXPECT_EQ(nearestName("x", {"a", "b"}), "");
  EXPECT_EQ(nearestName("", {"train"}), "");
  EXPECT_EQ(nearestName("banana", {"train", "detect", "bag"}), "");
  EXPECT_EQ(nearestNameHint("banana", {"train", "detect"}), "there are: train, detect");
  EXPECT_EQ(nearestNameHint("trian", {"train", "detect"}), "did you mean 'train'?");
  EXPECT_EQ(nearestNameHint("trian", {}), "there are none");
}

TEST(NearestName, TakesNoLongerForEndlessText) {
  const std::string endless(10000000, 'x');
  EXPECT_EQ(nearestName("clodu" + endless, {"kind" + endless, "cloud" + endless}), "cloud" + endless);
}

}  // namespace
}  // namespace sks
