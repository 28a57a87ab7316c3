// SPDX-License-Identifier: BSD-3-Clause
// The camera moves, and no frame is known in which things stand still.
#include <sks_detector/tracker.hpp>

#include <algorithm>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/tracking/scene_motion.hpp"
#include "tracker_scene.hpp"

namespace sks {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

class TrackerWithoutFixedFrame : public TrackerTest {
protected:
  static DetectionResult only(const std::string& name, DetectionResult found) {
    auto& all = found.detections;
    all.erase(std::remove_if(all.begin(), all.end(), [&](const Detection& d) { return d.object != name; }), all.end());
    return found;
  }

  /// As a search may see what looks nearly alike from behind.
  static DetectionResult byHalfATurn(const std::string& name, DetectionResult found) {
    for (Detection& detection : found.detections) {
      if (detection.object != name) continue;
      detection.T_scene_model.rotate(Eigen::AngleAxisd(EIGEN_PI, Eigen::Vector3d::UnitZ()));
    }
    return found;
  }
};

TEST_F(TrackerWithoutFixedFrame, ACameraThatMovesIsFollowedToo) {
  begin(false);
  for (int i = 1; i <= 15; ++i) {
    look(0.005 * i);
    const auto objects = next(false);
    ASSERT_THAT(objects, SizeIs(2));
    for (const TrackedObject& object : objects) expectRight(object, 6, 3);
  }
  EXPECT_EQ(tracker_.counts().begun, 2u);
}

TEST_F(TrackerWithoutFixedFrame, ALateDetectionGoesWithWhatIsFollowed) {
  look(0);
  const CloudView earlier = view(false);
  const DetectionResult found = detector_.detect(see()), duck = only("duck", found), drill = only("drill", found);
  tracker_.take(duck, earlier);
  for (int i = 0; i <= 15; ++i) {
    look(0.02 * i);
    ASSERT_THAT(next(false), SizeIs(1));
  }
  tracker_.take(drill, earlier);
  const auto objects = next(false);
  ASSERT_THAT(objects, SizeIs(2));
  for (const TrackedObject& object : objects) expectRight(object, 6, 3);
}

TEST_F(TrackerWithoutFixedFrame, TheFirstSearchMayArriveLate) {
  look(0);
  const CloudView earlier = view(false);
  const Cloud searched = see();
  tracker_.follow(searched, earlier);
  for (int i = 1; i <= 15; ++i) {
    look(0.02 * i);
    ASSERT_THAT(next(false), IsEmpty());
  }
  tracker_.take(detector_.detect(searched), earlier);
  const auto objects = next(false);
  ASSERT_THAT(objects, SizeIs(2));
  for (const TrackedObject& object : objects) expectRight(object, 6, 3);
}

TEST_F(TrackerWithoutFixedFrame, TheSceneAsAWholeTellsHowTheCameraMoved) {
  SceneMotion scene;
  const Settings& settings = codebook_->settings;
  look(0);
  const Eigen::Isometry3d T_table_first = T_table_camera_;
  for (int i = 0; i <= 15; ++i) {
    look(0.02 * i);
    scene.add(see(), stamp_ + i / 30.0);
  }
  const auto motion = scene.since(stamp_, settings);
  ASSERT_TRUE(motion.has_value());
  const Eigen::Isometry3d error = T_table_camera_.inverse() * T_table_first * motion->inverse();
  const Eigen::Vector3d middle = T_table_camera_.inverse() * Eigen::Vector3d::Zero();
  EXPECT_LT((error * middle - middle).norm(), 0.005);
  EXPECT_LT(Eigen::AngleAxisd(error.linear()).angle(), 0.01);
  EXPECT_EQ(scene.since(stamp_, settings)->matrix(), motion->matrix());

  EXPECT_TRUE(scene.since(stamp_ + 0.5, settings)->isApprox(Eigen::Isometry3d::Identity(), 0));
  EXPECT_FALSE(scene.since(stamp_ - 1, settings).has_value()) << "no such cloud";
  Cloud nothing = see();
  for (auto& point : nothing.points) point.setConstant(std::numeric_limits<float>::quiet_NaN());
  scene.add(nothing, stamp_ + 0.6);
  EXPECT_FALSE(scene.since(stamp_, settings).has_value());
  scene.add(see(), stamp_ + 10);
  EXPECT_FALSE(scene.since(stamp_, settings).has_value()) << "too long ago";
}

TEST_F(TrackerWithoutFixedFrame, WhatIsFoundWithAnotherPoseDoesNotTellTheMotionOfTheCamera) {
  put("duck", 0, 0);
  put("drill", 0.27, 0.05);
  look(0);
  const CloudView first = view(false);
  const DetectionResult turned = byHalfATurn("duck", detector_.detect(see()));
  look(0.6);
  next(false);
  tracker_.take(turned, first);
  ASSERT_THAT(next(false), IsEmpty());
  const CloudView second = view(false);
  const DetectionResult found = detector_.detect(see());
  look(0.7);
  ASSERT_THAT(next(false), IsEmpty());
  tracker_.take(found, second);
  for (int i = 0; i < 3; ++i) next(false);
  const auto objects = next(false);
  ASSERT_THAT(objects, SizeIs(2));
  for (const TrackedObject& object : objects) expectRight(object, 6, 3);
}

}  // namespace
}  // namespace sks
