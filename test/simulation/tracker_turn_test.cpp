// SPDX-License-Identifier: BSD-3-Clause
// Turns that a shape tells little about, while the object stands and while it is turned.
#include <sks_detector/tracker.hpp>

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/simulation/training_views.hpp>

#include "simulation/builtin_objects.hpp"
#include "simulation/renderer.hpp"
#include "simulation/shapes.hpp"

namespace sks {
namespace {

using ::testing::SizeIs;

constexpr double in_degrees = 180 / double(EIGEN_PI);

/// One object alone on a table before a camera that stands still.
class OneObject {
public:
  explicit OneObject(const std::string& name) : mesh_(std::make_shared<const Mesh>(builtinObject(name))) {
    codebook_ = std::make_shared<const Codebook>(train(meshSamples(name, name, mesh_, {}), {}, name));
    renderer_.addInstance(
        renderer_.addMesh(std::make_shared<const Mesh>(makeBox({1.2f, 1.2f, 0.02f}, plain({170, 160, 150})))),
        Eigen::Isometry3d(Eigen::Translation3d(0, 0, -0.01)));
    instance_ = renderer_.addInstance(renderer_.addMesh(mesh_), Eigen::Isometry3d::Identity());
  }

  void turn(double degrees) {
    T_table_object_ = Eigen::AngleAxisd(degrees / in_degrees, Eigen::Vector3d::UnitZ());
    renderer_.moveInstance(instance_, T_table_object_);
  }

  Cloud see() { return renderer_.render({}, T_table_camera_, picture_++, 2).cloud; }
  CloudView view() const { return {stamp_, T_table_camera_}; }
  CloudView later() {
    stamp_ += 1.0 / 30;
    return view();
  }

  /// From where the object is truly.
  Eigen::AngleAxisd turnOf(const TrackedObject& object) const {
    return Eigen::AngleAxisd((T_table_object_.inverse() * T_table_camera_ * object.detection.T_scene_model).linear());
  }

  std::shared_ptr<const Codebook> codebook_;

private:
  std::shared_ptr<const Mesh> mesh_;
  Renderer renderer_;
  std::size_t instance_ = 0;
  Eigen::Isometry3d T_table_object_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_table_camera_ = lookAt({0.3, -0.7, 0.5}, {0, 0, 0.08}, Eigen::Vector3d::UnitZ());
  std::uint64_t picture_ = 0;
  double stamp_ = 100;
};

TEST(TrackerTurn, ABottleThatStandsDoesNotTurnFromCloudToCloud) {
  OneObject bottle("bottle");
  Tracker tracker{Detector(bottle.codebook_)};
  const DetectionResult found = Detector(bottle.codebook_).detect(bottle.see());
  ASSERT_THAT(found.above(0.5), SizeIs(1));
  tracker.take(found, bottle.view());
  Eigen::Matrix3d before = found.detections.front().T_scene_model.linear();
  const Eigen::Matrix3d first = before;
  for (int i = 0; i < 30; ++i) {
    const CloudView view = bottle.later();
    const std::vector<TrackedObject> objects = tracker.follow(bottle.see(), view);
    ASSERT_THAT(objects, SizeIs(1));
    const Eigen::Matrix3d now = objects[0].detection.T_scene_model.linear();
    EXPECT_LT(Eigen::AngleAxisd(before.transpose() * now).angle() * in_degrees, 1) << i;
    EXPECT_LT(Eigen::AngleAxisd(first.transpose() * now).angle() * in_degrees, 5) << i;
    before = now;
  }
}

TEST(TrackerTurn, ADuckThatIsTurnedIsFollowed) {
  OneObject duck("duck");
  Tracker tracker{Detector(duck.codebook_)};
  tracker.take(Detector(duck.codebook_).detect(duck.see()), duck.view());
  for (int i = 0; i < 20; ++i) {
    duck.turn(2 * i);
    const CloudView view = duck.later();
    const std::vector<TrackedObject> objects = tracker.follow(duck.see(), view);
    ASSERT_THAT(objects, SizeIs(1));
    EXPECT_LT(duck.turnOf(objects[0]).angle() * in_degrees, 2) << i;
  }
}

}  // namespace
}  // namespace sks
