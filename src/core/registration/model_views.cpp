// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/model_views.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "core/registration/model_fusion.hpp"
#include "core/surface/even_directions.hpp"

namespace sks {
namespace {

constexpr int directions = 42;                 // about 30 degrees apart, as those of meshes
constexpr double farthest_from_camera = 0.44;  // [rad] 25 degrees: what is seen from there a camera has seen as well
constexpr float grazing = 0.17f;               // cosine of 80 degrees: a camera does not see what is more at a slant
constexpr float cell_size = 1.5f;              // [spacings of the model] as seen from the camera
constexpr double sparsest = 0.5;               // of a normal's radius: what lies farther apart has no normals
constexpr std::size_t fewest_points = 50;      // of a view, as of an object that is captured
constexpr float thickness = 2;                 // [spacings] nearer points hide those that lie deeper than this

/// Points of a model that a camera sees: those that face it with nothing before them.
class VisiblePoints {
public:
  VisiblePoints(const FusedModel& model, float spacing, const Eigen::Vector3f& eye)
      : model_(model), spacing_(spacing), eye_(eye) {
    const Eigen::Vector3f forward = (model.box.center() - eye).normalized();
    right_ = forward.unitOrthogonal();
    down_ = forward.cross(right_);
    forward_ = forward;
    cell_ = cell_size * spacing / (model.box.center() - eye).norm();
    for (const Eigen::Vector3f& p : model.points) {
      const Pixel at = pixelOf(p);
      const auto known = nearest_.emplace(key(at.column, at.row), at.depth).first;
      known->second = std::min(known->second, at.depth);
    }
  }

  bool sees(std::size_t i) const {
    const Eigen::Vector3f& p = model_.points[i];
    const float cosine = model_.normals[i].dot((eye_ - p).normalized());
    if (cosine < grazing) return false;
    const float slope = std::sqrt(1 - cosine * cosine) / cosine;
    const Pixel at = pixelOf(p);
    const float deepest = at.depth - spacing_ * (thickness + cell_size * slope);  // its own surface comes nearer
    for (int row = at.row - 1; row <= at.row + 1; ++row) {
      for (int column = at.column - 1; column <= at.column + 1; ++column) {
        const auto before = nearest_.find(key(column, row));
        if (before != nearest_.end() && before->second < deepest) return false;
      }
    }
    return true;
  }

private:
  struct Pixel {
    int column, row;
    float depth;
  };

  Pixel pixelOf(const Eigen::Vector3f& p) const {
    const Eigen::Vector3f from_eye = p - eye_;
    const float depth = from_eye.dot(forward_);
    return {int(std::floor(from_eye.dot(right_) / (depth * cell_))),
            int(std::floor(from_eye.dot(down_) / (depth * cell_))), depth};
  }

  static std::uint64_t key(int column, int row) {
    return std::uint64_t(std::uint32_t(column)) << 32 | std::uint32_t(row);
  }

  const FusedModel& model_;
  float spacing_;
  Eigen::Vector3f eye_, forward_, right_, down_;
  float cell_;                                        // edge at unit depth
  std::unordered_map<std::uint64_t, float> nearest_;  // depth in each cell that has points [m]
};

Cloud visibleCloud(const FusedModel& model, float spacing, const Eigen::Vector3f& eye) {
  const VisiblePoints visible(model, spacing, eye);
  Cloud cloud;
  cloud.sensor_origin = eye;
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    if (!visible.sees(i)) continue;
    cloud.points.push_back(model.points[i]);
    if (!model.colors.empty()) cloud.colors.push_back(model.colors[i]);
  }
  return cloud;
}

Cloud moved(Cloud cloud, const Eigen::Isometry3d& motion) {
  const Eigen::Isometry3f T = motion.cast<float>();
  for (Eigen::Vector3f& p : cloud.points) p = T * p;
  cloud.sensor_origin = T * cloud.sensor_origin;
  return cloud;
}

}  // namespace

std::vector<TrainingSample> modelSamples(const RegisteredObject& object, const Settings& settings) {
  std::vector<TrainingSample> samples;
  const double spacing = fusedSpacing(settings);
  if (object.model.points.empty() || spacing > sparsest * settings.surface.normal_radius) return samples;
  const Eigen::Vector3d center = object.model.box.center().cast<double>();
  for (const Eigen::Vector3d& direction : evenDirections(directions)) {
    const RegisteredView* nearest = nullptr;
    double best = std::cos(farthest_from_camera);
    for (const RegisteredView& view : object.views) {
      const double cosine = direction.dot((view.sensor - center).normalized());
      if (!view.T_model_view || cosine < best) continue;
      best = cosine;
      nearest = &view;
    }
    if (nearest == nullptr) continue;
    const double distance = (nearest->sensor - center).norm();
    Cloud cloud = visibleCloud(object.model, float(spacing), (center + distance * direction).cast<float>());
    if (cloud.size() < fewest_points) continue;
    TrainingSample sample;
    sample.object = object.object;
    sample.source = object.frame + "/" + std::to_string(samples.size());
    sample.frame = object.frame;
    sample.box = object.model.box;
    sample.T_model_source = nearest->T_model_view;
    sample.load = [cloud = moved(std::move(cloud), nearest->T_model_view->inverse())] { return cloud; };
    samples.push_back(std::move(sample));
  }
  return samples;
}

}  // namespace sks
