// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <sks_detector/registration.hpp>
#include <sks_detector/simulation/camera_presets.hpp>

#include "core/capture/tabletop.hpp"
#include "simulation/builtin_objects.hpp"
#include "table_scene.hpp"

namespace sks::test {

/// An object that stands in the middle of a table.
class TableView {
public:
  static constexpr double distance = 0.7, elevation = 0.6;  ///< of the camera [m], [rad]

  explicit TableView(const std::string& object)
      : object_(object), mesh_(std::make_shared<const Mesh>(builtinObject(object))) {
    target_ = Eigen::Vector3d(0, 0, 0.5 * double(mesh_->box().sizes().z()));
    addTable(*renderer_);
    renderer_->addInstance(renderer_->addMesh(mesh_), standingPose(*mesh_));
  }

  Eigen::Isometry3d T_table_camera(double degrees) const { return cameraAt(target_, degrees, elevation, distance); }

  Cloud picture(double degrees, std::uint64_t noise) const {
    return renderer_->render(cameraPreset("kinect"), T_table_camera(degrees), noise, 2).cloud;
  }

  /// As ~capture_view takes it.
  TrainingSample capture(double degrees, std::uint64_t noise = 0) const {
    return captured(picture(degrees, noise + std::uint64_t(degrees)), degrees);
  }

  /// The same while somebody holds the object.
  TrainingSample captureWithArm(double degrees) const {
    const std::size_t instance = addForearm(*renderer_, turnedBy(degrees));
    const TrainingSample sample = captured(picture(degrees, std::uint64_t(degrees)), degrees);
    renderer_->setVisible(instance, false);
    return sample;
  }

  std::vector<TrainingSample> captureAround(int views, double from = 10, double to = 370) const {
    std::vector<TrainingSample> samples;
    for (int i = 0; i < views; ++i) samples.push_back(capture(std::floor(from + (to - from) * i / views)));
    return samples;
  }

  /// How far the model frames that the poses of the views lead to lie apart: at the object's middle [m], and [rad].
  std::pair<double, double> spread(const RegisteredObject& object, const std::vector<double>& degrees) const {
    std::optional<Eigen::Isometry3d> first;
    std::pair<double, double> largest(0, 0);
    for (std::size_t v = 0; v < object.views.size(); ++v) {
      if (!object.views[v].T_model_view) continue;
      const Eigen::Isometry3d T = T_table_camera(degrees[v]) * object.views[v].T_model_view->inverse();
      if (!first) first = T;
      const Eigen::Vector3d middle = first->inverse() * target_;
      largest.first = std::max(largest.first, (T * middle - target_).norm());
      largest.second = std::max(largest.second, Eigen::AngleAxisd(first->linear().transpose() * T.linear()).angle());
    }
    return largest;
  }

  Eigen::Vector3f size() const { return mesh_->box().sizes(); }

private:
  TrainingSample captured(const Cloud& picture_of_all, double degrees) const {
    const Tabletop top = findTabletop(picture_of_all);
    TrainingSample sample;
    sample.object = object_;
    sample.source = object_ + std::to_string(int(degrees));
    sample.load = [cloud = cutOut(picture_of_all, top.objects.at(0))] { return cloud; };
    sample.plane = top.plane.cast<double>();
    return sample;
  }

  std::string object_;
  std::shared_ptr<const Mesh> mesh_;
  std::shared_ptr<Renderer> renderer_ = std::make_shared<Renderer>();
  Eigen::Vector3d target_;
};

}  // namespace sks::test
