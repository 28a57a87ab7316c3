// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/sequence.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.hpp"
#include "simulation/builtin_objects.hpp"

namespace sks {
namespace {

using ::testing::HasSubstr;

std::vector<SceneModel> householdModels() {
  std::vector<SceneModel> models;
  for (const std::string& name : builtinNames()) {
    models.push_back({name, "builtin:" + name, std::make_shared<const Mesh>(builtinObject(name))});
  }
  return models;
}

SceneOptions smallPictures() {
  SceneOptions options;
  options.objects = 3;
  options.distractors = 1;
  options.camera.width = 160, options.camera.height = 120;
  options.camera.fx = options.camera.fy = 131;
  options.camera.cx = 79.5, options.camera.cy = 59.5;
  return options;
}

Eigen::Isometry3d onTable(const SequenceFrame& frame, std::size_t object) {
  return frame.scene.T_table_camera * frame.scene.objects[object].T_camera_model;
}

TEST(Sequence, OnlyThePushedObjectMoves) {
  SimulatedSequence sequence(householdModels(), smallPictures(), {2, 10, 20, true, false}, 0);
  ASSERT_EQ(sequence.size(), 20u);
  const SequenceFrame first = sequence.at(0), last = sequence.at(19);
  EXPECT_EQ(first.stamp, 0);
  EXPECT_NEAR(last.stamp, 1.9, 1e-9);
  ASSERT_LT(sequence.pushed(), first.scene.objects.size());
  for (std::size_t i = 0; i < first.scene.objects.size(); ++i) {
    const double moved = (onTable(first, i).translation() - onTable(last, i).translation()).norm();
    EXPECT_NEAR(moved, i == sequence.pushed() ? 0.1 : 0, 1e-6);
  }
  EXPECT_GT((first.scene.T_table_camera.translation() - last.scene.T_table_camera.translation()).norm(), 0.1);
}

TEST(Sequence, TheHandHidesObjectsAndGoesAway) {
  SimulatedSequence sequence(householdModels(), smallPictures(), {2, 10, 0, false, true}, 0);
  EXPECT_EQ(sequence.pushed(), sequence.at(0).scene.objects.size());
  const auto visible = [&](std::size_t frame) {
    double sum = 0;
    for (const ScenePlacement& object : sequence.at(frame).scene.objects) sum += object.visibility;
    return sum;
  };
  const double before = visible(5);
  EXPECT_LT(visible(14), before - 0.5);
  EXPECT_NEAR(visible(18), before, 0.02);
}

TEST(Sequence, SameNumberSamePicturesInAnyOrder) {
  SimulatedSequence a(householdModels(), smallPictures(), {1, 10, 20, true, true}, 1);
  SimulatedSequence b(householdModels(), smallPictures(), {1, 10, 20, true, true}, 1);
  a.at(2);
  const SequenceFrame late = a.at(7);
  b.at(9);
  EXPECT_EQ(b.at(7).scene.view.instance, late.scene.view.instance);
}

TEST(Sequence, RefusesImpossibleOptions) {
  const auto refusal = [](const SequenceOptions& options) {
    return test::errorOf(ErrorCode::bad_usage,
                         [&] { SimulatedSequence(householdModels(), smallPictures(), options, 0); });
  };
  EXPECT_THAT(refusal({0, 30, 20, true, true}), HasSubstr("seconds = 0"));
  EXPECT_THAT(refusal({1, -1, 20, true, true}), HasSubstr("rate"));
  EXPECT_THAT(refusal({1, 30, 200, true, true}), HasSubstr("swing"));
}

}  // namespace
}  // namespace sks
