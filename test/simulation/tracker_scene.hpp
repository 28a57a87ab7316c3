// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/simulation/training_views.hpp>
#include <sks_detector/tracker.hpp>

#include "simulation/builtin_objects.hpp"
#include "simulation/renderer.hpp"
#include "simulation/shapes.hpp"

namespace sks {

/// A table with a duck and a drill, before a camera that can be moved.
class TrackerTest : public ::testing::Test {
protected:
  static void SetUpTestSuite() {
    std::vector<TrainingSample> samples;
    for (const char* name : {"duck", "drill"}) {
      const auto mesh = std::make_shared<const Mesh>(builtinObject(name));
      for (const TrainingSample& sample : meshSamples(name, name, mesh, {})) samples.push_back(sample);
    }
    codebook_ = std::make_shared<const Codebook>(train(samples, {}, "two"));
  }
  static void TearDownTestSuite() { codebook_.reset(); }

  TrackerTest() : detector_(codebook_), tracker_(detector_) {
    const auto paint = plain({170, 160, 150});
    renderer_.addInstance(renderer_.addMesh(std::make_shared<const Mesh>(makeBox({1.2f, 1.2f, 0.02f}, paint))),
                          Eigen::Isometry3d(Eigen::Translation3d(0, 0, -0.01)));
    for (const char* name : {"duck", "drill"}) {
      instances_[name] =
          renderer_.addInstance(renderer_.addMesh(std::make_shared<const Mesh>(builtinObject(name))), place(0, 0));
    }
    put("duck", -0.15, 0);
    put("drill", 0.13, 0.05);
    cover_ = renderer_.addInstance(renderer_.addMesh(std::make_shared<const Mesh>(makeBox({0.3f, 0.02f, 0.4f}, paint))),
                                   Eigen::Isometry3d(Eigen::Translation3d(-0.15, -0.25, 0.2)));
    renderer_.setVisible(cover_, false);
  }

  static Eigen::Isometry3d place(double x, double y) { return Eigen::Isometry3d(Eigen::Translation3d(x, y, 0)); }

  void put(const std::string& name, double x, double y) {
    T_table_object_[name] = place(x, y);
    renderer_.moveInstance(instances_[name], place(x, y));
  }

  /// Looks at the table from a direction [rad].
  void look(double direction) {
    T_table_camera_ =
        lookAt({0.75 * std::sin(direction), -0.75 * std::cos(direction), 0.5}, {0, 0, 0.05}, Eigen::Vector3d::UnitZ());
  }

  Cloud see() { return renderer_.render({}, T_table_camera_, picture_++, 2).cloud; }

  CloudView view(bool fixed = true) const {
    CloudView view{stamp_, {}};
    if (fixed) view.T_fixed_cloud = T_table_camera_;
    return view;
  }

  /// One more cloud, a thirtieth of a second later.
  std::vector<TrackedObject> next(bool fixed = true) {
    stamp_ += 1.0 / 30;
    return tracker_.follow(see(), view(fixed));
  }

  void search(bool fixed = true) {
    const CloudView now = view(fixed);
    tracker_.take(detector_.detect(see(), nullptr, tracker_.occupied()), now);
  }

  /// Follows both objects.
  void begin(bool fixed = true) {
    look(0);
    search(fixed);
    ASSERT_THAT(next(fixed), ::testing::SizeIs(2));
  }

  void expectRight(const TrackedObject& object, double millimetres = 3, double degrees = 2) const {
    const Eigen::Isometry3d truth = T_table_camera_.inverse() * T_table_object_.at(object.detection.object);
    const Eigen::Isometry3d error = truth.inverse() * object.detection.T_scene_model;
    EXPECT_LT(error.translation().norm(), 1e-3 * millimetres) << object.detection.object;
    EXPECT_LT(Eigen::AngleAxisd(error.linear()).angle(), degrees * EIGEN_PI / 180) << object.detection.object;
  }

  static std::uint32_t idOf(const std::vector<TrackedObject>& objects, const std::string& name) {
    for (const TrackedObject& object : objects) {
      if (object.detection.object == name) return object.id;
    }
    return 0;
  }

  inline static std::shared_ptr<const Codebook> codebook_;
  Detector detector_;
  Tracker tracker_;
  Renderer renderer_;
  std::map<std::string, std::size_t> instances_;
  std::map<std::string, Eigen::Isometry3d> T_table_object_;
  std::size_t cover_ = 0;
  Eigen::Isometry3d T_table_camera_ = Eigen::Isometry3d::Identity();
  std::uint64_t picture_ = 0;
  double stamp_ = 100;
};

}  // namespace sks
