// SPDX-License-Identifier: BSD-3-Clause
#include "core/keypoints/range_thinning.hpp"

#include <gtest/gtest.h>

#include "core/surface/angular_spacing.hpp"

namespace sks::test {
namespace {

constexpr double normal_radius = 0.01, spacing = 0.002;  // [m], [rad]
constexpr double well_sampled = normal_radius / (4 * spacing);

/// Two patches before a sensor, measured along rays that lie evenly apart, at two ranges.
Surface patches(double near, double far) {
  Cloud cloud;
  for (const auto& [range, side] : {std::make_pair(near, -1.0), std::make_pair(far, 1.0)}) {
    for (int row = -50; row < 50; ++row) {
      for (int column = 0; column < 100; ++column) {
        cloud.points.emplace_back(float(range * spacing * side * (column + 1)), float(range * spacing * row),
                                  float(range));
      }
    }
  }
  return makeSurface(cloud, normal_radius, 1);
}

Keypoints keypointsAt(double range, int count) {
  Keypoints keypoints;
  for (int i = 0; i < count; ++i) {
    keypoints.positions.emplace_back(0.0f, 0.0f, float(range));
    keypoints.normals.emplace_back(0.0f, 0.0f, -1.0f);
    keypoints.curvature.push_back(float(i));
  }
  return keypoints;
}

TEST(AngularSpacing, IsThatOfTheRaysWhateverTheRange) {
  EXPECT_NEAR(angularSpacing(patches(0.5, 1.5), float(normal_radius)), spacing, 0.1 * spacing);
}

TEST(AngularSpacing, NothingIsSampledWorseThanNotAtAll) {
  EXPECT_EQ(angularSpacing(Surface(), float(normal_radius)), 0);
  EXPECT_EQ(samplingAt(1, 0, normal_radius), 1);
}

TEST(AngularSpacing, SamplingFallsWithTheRange) {
  EXPECT_EQ(samplingAt(0.9 * well_sampled, spacing, normal_radius), 1);
  EXPECT_NEAR(samplingAt(2 * well_sampled, spacing, normal_radius), 0.5, 1e-9);
}

TEST(RangeThinning, KeepsAllThatIsWellSampled) {
  const Keypoints near = keypointsAt(0.9, 40);
  const Keypoints kept = thinnedByRange(near, patches(0.9, 2), normal_radius);
  EXPECT_EQ(kept.positions, near.positions);
  EXPECT_EQ(kept.normals, near.normals);
  EXPECT_EQ(kept.curvature, near.curvature);
}

TEST(RangeThinning, KeepsAQuarterAtTwiceTheRangeEvenly) {
  const Keypoints kept = thinnedByRange(keypointsAt(2 * well_sampled, 400), patches(0.9, 2), normal_radius);
  EXPECT_NEAR(double(kept.size()), 100, 15);
  for (std::size_t i = 1; i < kept.size(); ++i) EXPECT_LE(kept.curvature[i] - kept.curvature[i - 1], 6);
}

TEST(RangeThinning, LeavesOutWhatIsNotKnown) {
  Keypoints keypoints = keypointsAt(0.9, 3);
  keypoints.normals.clear();
  keypoints.curvature.clear();
  const Keypoints kept = thinnedByRange(keypoints, patches(0.9, 2), normal_radius);
  EXPECT_EQ(kept.size(), 3u);
  EXPECT_TRUE(kept.normals.empty());
  EXPECT_TRUE(kept.curvature.empty());
}

}  // namespace
}  // namespace sks::test
