// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/tracker.hpp>

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.hpp"
#include "tracker_scene.hpp"

namespace sks {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST_F(TrackerTest, FollowsWhatOneSearchFoundWhileTheCameraMoves) {
  begin();
  const auto first = tracker_.follow(see(), view());
  const std::uint32_t duck = idOf(first, "duck"), drill = idOf(first, "drill");
  EXPECT_NE(duck, drill);
  EXPECT_FALSE(tracker_.wantsDetection(stamp_));
  for (int i = 1; i <= 15; ++i) {
    look(0.02 * i);
    const auto objects = next();
    ASSERT_THAT(objects, SizeIs(2));
    EXPECT_EQ(idOf(objects, "duck"), duck);
    EXPECT_EQ(idOf(objects, "drill"), drill);
    for (const TrackedObject& object : objects) {
      expectRight(object);
      EXPECT_TRUE(object.seen);
      EXPECT_EQ(object.unseen, 0);
      EXPECT_GT(object.detection.score, 0.9);
    }
  }
  EXPECT_EQ(tracker_.counts().begun, 2u);
  EXPECT_EQ(tracker_.counts().identity_changes, 0u);
  EXPECT_TRUE(tracker_.wantsDetection(stamp_ + codebook_->settings.tracker.redetect));
}

TEST_F(TrackerTest, IsTheSameForAnyNumberOfThreads) {
  Settings settings = codebook_->settings;
  settings.threads = 1;
  Tracker one(detector_.withSettings(settings));
  settings.threads = 8;
  Tracker eight(detector_.withSettings(settings));
  look(0);
  const DetectionResult found = detector_.detect(see());
  one.take(found, view());
  eight.take(found, view());
  for (int i = 0; i < 3; ++i) {
    stamp_ += 0.3;
    const Cloud cloud = see();
    const auto a = one.follow(cloud, view()), b = eight.follow(cloud, view());
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
      EXPECT_EQ(a[k].id, b[k].id);
      EXPECT_EQ(a[k].detection.score, b[k].detection.score);
      EXPECT_EQ(a[k].detection.T_scene_model.matrix(), b[k].detection.T_scene_model.matrix());
    }
  }
}

TEST_F(TrackerTest, WhatStandsDoesNotJitter) {
  begin();
  for (int i = 0; i < 15; ++i) next();
  Eigen::AlignedBox3d positions;
  for (int i = 0; i < 15; ++i) {
    for (const TrackedObject& object : next()) {
      if (object.detection.object == "duck") positions.extend(object.detection.T_scene_box.translation());
    }
  }
  EXPECT_LT(positions.sizes().norm(), 0.001);
}

TEST_F(TrackerTest, ASecondWithoutCloudsDoesNoHarm) {
  begin();
  const std::uint32_t duck = idOf(next(), "duck");
  stamp_ += 1;
  look(0.3);
  const auto objects = next();
  ASSERT_THAT(objects, SizeIs(2));
  EXPECT_EQ(idOf(objects, "duck"), duck);
  for (const TrackedObject& object : objects) expectRight(object);
}

TEST_F(TrackerTest, WhatWasTakenAwayIsNotToldAndSoonForgotten) {
  begin();
  renderer_.setVisible(instances_["duck"], false);
  const auto objects = next();
  EXPECT_EQ(idOf(objects, "duck"), 0u);
  EXPECT_NE(idOf(objects, "drill"), 0u);
  EXPECT_TRUE(tracker_.wantsDetection(stamp_));
  EXPECT_EQ(tracker_.size(), 2u);
  stamp_ += codebook_->settings.tracker.max_age;
  next();
  EXPECT_EQ(tracker_.size(), 1u);
  EXPECT_EQ(tracker_.counts().lost, 1u);
}

TEST_F(TrackerTest, WhatIsHiddenIsRememberedForAWhile) {
  begin();
  const std::uint32_t duck = idOf(next(), "duck");
  renderer_.setVisible(cover_, true);
  stamp_ += 0.3;
  const auto hidden = next();
  ASSERT_EQ(idOf(hidden, "duck"), duck);
  for (const TrackedObject& object : hidden) {
    expectRight(object);
    if (object.id != duck) continue;
    EXPECT_FALSE(object.seen);
    EXPECT_NEAR(object.unseen, 0.3 + 1.0 / 30, 1e-6);
    EXPECT_LT(object.detection.score, 0.9);
  }
  renderer_.setVisible(cover_, false);
  EXPECT_EQ(idOf(next(), "duck"), duck);
  renderer_.setVisible(cover_, true);
  stamp_ += 1.1 * codebook_->settings.tracker.max_age;
  EXPECT_EQ(idOf(next(), "duck"), 0u);
  EXPECT_EQ(tracker_.size(), 1u);
}

TEST_F(TrackerTest, WhereNothingWasMeasuredNothingIsTold) {
  begin();
  Cloud lost = see();
  for (auto& point : lost.points) point.setConstant(std::numeric_limits<float>::quiet_NaN());
  stamp_ += 0.1;
  EXPECT_THAT(tracker_.follow(lost, view()), IsEmpty());
  EXPECT_THAT(next(), SizeIs(2));
}

TEST_F(TrackerTest, WhatIsFoundElsewhereIsTheSameObject) {
  begin();
  const std::uint32_t duck = idOf(next(), "duck");
  put("duck", -0.1, 0.2);
  for (int i = 0; i < 6; ++i) next();
  search();
  const auto objects = next();
  EXPECT_EQ(idOf(objects, "duck"), duck);
  EXPECT_EQ(tracker_.counts().found_again, 1u);
  for (const TrackedObject& object : objects) expectRight(object);
}

TEST_F(TrackerTest, ALateDetectionOfAnEarlierCloudBeginsATrackWhereTheObjectIsNow) {
  look(0);
  const CloudView earlier = view();
  const DetectionResult found = detector_.detect(see());
  for (int i = 1; i <= 10; ++i) {
    look(0.02 * i);
    EXPECT_THAT(next(), IsEmpty());
  }
  tracker_.take(found, earlier);
  const auto objects = next();
  ASSERT_THAT(objects, SizeIs(2));
  for (const TrackedObject& object : objects) expectRight(object);
}

TEST_F(TrackerTest, WhatOneCloudAloneShowedIsNotTold) {
  look(0);
  DetectionResult found = detector_.detect(see());
  Detection doubtful = found.detections.front();
  doubtful.T_scene_model.pretranslate(Eigen::Vector3d(0, 0.12, 0));
  doubtful.T_scene_box.pretranslate(Eigen::Vector3d(0, 0.12, 0));
  doubtful.score = 0.6;
  found.detections = {doubtful};
  tracker_.take(found, view());
  for (int i = 0; i < 3; ++i) EXPECT_THAT(next(), IsEmpty());
  EXPECT_EQ(tracker_.counts().lost, 0u);
}

TEST_F(TrackerTest, WhenTimeJumpsBackAllBeginsAnew) {
  begin();
  const std::uint32_t last = tracker_.nextId() - 1;
  stamp_ -= 50;
  EXPECT_THAT(next(), IsEmpty());
  EXPECT_EQ(tracker_.size(), 0u);
  EXPECT_TRUE(tracker_.wantsDetection(stamp_));
  search();
  for (const TrackedObject& object : next()) EXPECT_GT(object.id, last);
}

TEST_F(TrackerTest, AnotherReferenceFrameLeavesTheObjectsWhereTheyAre) {
  begin(false);
  const std::uint32_t duck = idOf(next(false), "duck");
  const auto objects = next(true);
  EXPECT_EQ(idOf(objects, "duck"), duck);
  for (const TrackedObject& object : objects) expectRight(object);
}

TEST_F(TrackerTest, WhereTwoSearchesFoundThemNothingIsSearched) {
  begin();
  for (int i = 0; i < 3; ++i) next();
  EXPECT_THAT(tracker_.occupied(), IsEmpty());
  search();
  ASSERT_THAT(tracker_.occupied(), SizeIs(2));
  EXPECT_THAT(detector_.detect(see(), nullptr, tracker_.occupied()).above(0.5), IsEmpty());
  EXPECT_THAT(detector_.detect(see()).above(0.5), SizeIs(2));
}

TEST_F(TrackerTest, ClearForgetsAllButNumbers) {
  begin();
  const std::uint32_t next_id = tracker_.nextId();
  tracker_.clear();
  EXPECT_EQ(tracker_.size(), 0u);
  EXPECT_EQ(tracker_.nextId(), next_id);
  EXPECT_TRUE(tracker_.wantsDetection(stamp_));
  EXPECT_EQ(Tracker(detector_, next_id).nextId(), next_id);
}

TEST_F(TrackerTest, RefusesWhatItCannotFollow) {
  Settings settings = codebook_->settings;
  settings.detection.hypotheses = Hypotheses::hough;
  const std::string refusal =
      test::errorOf(ErrorCode::bad_usage, [&] { Tracker tracker(detector_.withSettings(settings)); });
  EXPECT_THAT(refusal, HasSubstr("detection.hypotheses"));
  DetectionResult foreign;
  foreign.detections.resize(1);
  foreign.detections[0].object = "elephant";
  foreign.detections[0].score = 1;
  EXPECT_THAT(test::errorOf(ErrorCode::bad_usage, [&] { tracker_.take(foreign, view()); }), HasSubstr("elephant"));
}

}  // namespace
}  // namespace sks
