// SPDX-License-Identifier: BSD-3-Clause
#include "core/settings/nearest_name.hpp"

#include <gtest/gtest.h>

namespace sks {
namespace {

TEST(NearestName, IsTheOneWithTheFewestEdits) {
  EXPECT_EQ(nearestName("scene", {"name", "scenes", "tests"}), "scenes");
  EXPECT_EQ(nearestName("clodu", {"object", "kind", "cloud"}), "cloud");
  EXPECT_EQ(nearestName("x", {"a", "b"}), "a");
  EXPECT_EQ(nearestName("x", {}), "");
}

TEST(NearestName, TakesNoLongerForEndlessText) {
  const std::string endless(10000000, 'x');
  EXPECT_EQ(nearestName("clodu" + endless, {"kind" + endless, "cloud" + endless}), "cloud" + endless);
}

}  // namespace
}  // namespace sks
