// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/sequence.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <sks_detector/error.hpp>
#include <sks_detector/simulation/training_views.hpp>

#include "simulation/scene_random.hpp"
#include "simulation/shapes.hpp"
#include "simulation/table_stage.hpp"

namespace sks {
namespace {

constexpr double radians = EIGEN_PI / 180;
constexpr double around_period = 8, up_period = 5;  // [s] of the camera's motions
constexpr double up_swing = 4;                      // [deg]
constexpr double push_from = 0.3, push_to = 0.5;    // of the time
constexpr double push_way = 0.10;                   // [m]
constexpr double hand_from = 0.6, hand_to = 0.8;    // of the time
constexpr double hand_way = 1.0;                    // [m] to either side
constexpr double hand_height = 0.22;                // [m] above the table
constexpr double table_middle = 0.04;               // [m] height that the camera looks at

/// Part of a motion that is done: 0 before, 1 after, smooth at both ends.
double progress(double at, double from, double to) {
  const double x = std::clamp((at - from) / (to - from), 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

/// A fore-arm along x with a flat hand at its end, the hand at the origin.
Mesh makeArm() {
  const Rgb skin{205, 150, 125}, sleeve{60, 70, 95};
  Mesh arm = makeBox({0.11f, 0.085f, 0.03f}, plain(skin));
  for (int finger = 0; finger < 4; ++finger) {
    append(arm, movedTo(makeBox({0.075f, 0.016f, 0.016f}, plain(skin)), -0.09f, 0.021f * (float(finger) - 1.5f), 0));
  }
  append(arm, makeRod({0.05f, 0, 0.01f}, {0.65f, 0, 0.02f}, 0.035f, 0.05f, plain(sleeve), 0.1f));
  return arm;
}

}  // namespace

struct SimulatedSequence::State {
  State(const std::vector<SceneModel>& models, const SceneOptions& scene, const SequenceOptions& options,
        std::uint64_t scene_number)
      : sequence(options), number(scene_number), stage(models, scene, scene_number) {
    azimuth = 2 * EIGEN_PI * stage.random().uniform();
    elevation = between(stage.random(), scene.min_elevation, scene.max_elevation) * radians;
    distance = between(stage.random(), scene.min_distance, scene.max_distance);
    stage.addRoom(cameraAt(0));
    if (sequence.hand) arm = stage.addProp(std::make_shared<const Mesh>(makeArm()));
    choosePushed();
  }

  Eigen::Isometry3d cameraAt(double stamp) const {
    const double around = azimuth + sequence.swing * radians * std::sin(2 * EIGEN_PI * stamp / around_period);
    const double up = elevation + up_swing * radians * std::sin(2 * EIGEN_PI * stamp / up_period);
    const Eigen::Vector3d target(0, 0, table_middle);
    const Eigen::Vector3d direction(std::cos(up) * std::cos(around), std::cos(up) * std::sin(around), std::sin(up));
    return lookAt(target + distance * direction, target, Eigen::Vector3d::UnitZ());
  }

  /// The object that is farthest from the middle: outwards, its way is free.
  void choosePushed() {
    double farthest = -1;
    for (std::size_t i = 0, object = 0; i < stage.things().size(); ++i) {
      const TableThing& thing = stage.things()[i];
      if (thing.model < 0) continue;
      const Eigen::Vector3d middle = thing.T_table_thing * thing.mesh->box().center().cast<double>();
      if (sequence.push && middle.head<2>().norm() > farthest) {
        farthest = middle.head<2>().norm();
        pushed_thing = i;
        pushed_object = object;
        pushed_from = thing.T_table_thing;
        way = Eigen::Vector3d(middle.x(), middle.y(), 0).normalized();
      }
      objects = ++object;
    }
    if (farthest < 0) pushed_object = objects;
  }

  void moveThings(double part) {
    if (pushed_object < objects) {
      const Eigen::Vector3d moved = progress(part, push_from, push_to) * push_way * way;
      stage.moveInstance(pushed_thing, Eigen::Translation3d(moved) * pushed_from);
    }
    if (!sequence.hand) return;
    if (part < hand_from || part > hand_to) return stage.hideInstance(arm);
    // across the way between camera and objects, from one side of the camera to the other
    const Eigen::Vector3d towards(std::cos(azimuth), std::sin(azimuth), 0), aside(-towards.y(), towards.x(), 0);
    const double across = (2 * progress(part, hand_from, hand_to) - 1) * hand_way;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear().col(0) = aside;
    pose.linear().col(1) = Eigen::Vector3d::UnitZ().cross(aside);
    pose.linear().col(2) = Eigen::Vector3d::UnitZ();
    pose.translation() = 0.15 * towards + across * aside + hand_height * Eigen::Vector3d::UnitZ();
    stage.moveInstance(arm, pose);
  }

  SequenceOptions sequence;
  std::uint64_t number;
  TableStage stage;
  double azimuth = 0, elevation = 0, distance = 0;  // of the camera at first [rad], [m]
  std::size_t arm = 0, pushed_thing = 0, pushed_object = 0, objects = 0;
  Eigen::Isometry3d pushed_from = Eigen::Isometry3d::Identity();
  Eigen::Vector3d way = Eigen::Vector3d::UnitX();
};

SimulatedSequence::SimulatedSequence(const std::vector<SceneModel>& models, const SceneOptions& scene,
                                     const SequenceOptions& sequence, std::uint64_t number) {
  const auto check = [](bool good, const char* name, double value, const char* range) {
    if (!good)
      throw Error(ErrorCode::bad_usage,
                  std::string("sequence: ") + name + " = " + std::to_string(value) + " must be " + range);
  };
  check(sequence.seconds > 0 && sequence.seconds <= 3600, "seconds", sequence.seconds, "in (0, 3600] s");
  check(sequence.rate > 0 && sequence.rate <= 1000, "rate", sequence.rate, "in (0, 1000] Hz");
  check(std::abs(sequence.swing) <= 180, "swing", sequence.swing, "in [-180, 180] degrees");
  state_ = std::make_unique<State>(models, scene, sequence, number);
}

SimulatedSequence::~SimulatedSequence() = default;
SimulatedSequence::SimulatedSequence(SimulatedSequence&&) noexcept = default;
SimulatedSequence& SimulatedSequence::operator=(SimulatedSequence&&) noexcept = default;

std::size_t SimulatedSequence::size() const {
  return std::max<std::size_t>(1, std::size_t(std::lround(state_->sequence.seconds * state_->sequence.rate)));
}

std::size_t SimulatedSequence::pushed() const {
  return state_->pushed_object;
}

SequenceFrame SimulatedSequence::at(std::size_t frame) {
  State& s = *state_;
  SequenceFrame picture;
  picture.stamp = double(frame) / s.sequence.rate;
  s.moveThings(picture.stamp / s.sequence.seconds);
  picture.scene = s.stage.look(s.cameraAt(picture.stamp), s.number * size() + frame);
  return picture;
}

}  // namespace sks
