// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/simulation/training_views.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>

#include <sks_detector/error.hpp>

#include "core/settings/value_text.hpp"
#include "simulation/renderer.hpp"
#include "simulation/shapes.hpp"

namespace sks {
namespace {

/// Distance from which a ball just fits into the image.
double fittingDistance(const CameraModel& camera, double radius) {
  constexpr double margin = 1.1;
  const double slope = std::min(0.5 * camera.width / camera.fx, 0.5 * camera.height / camera.fy);
  return margin * radius / std::sin(std::atan(slope));
}

/// The camera with the part of its image alone in which a ball around the middle of its view is seen.
CameraModel croppedToBall(CameraModel camera, double radius, double distance) {
  constexpr double margin = 2;  // [px]
  const double slope = radius / std::sqrt(distance * distance - radius * radius);
  const auto crop = [slope](int& size, double& center, double focal_length) {
    if (!(center >= 0 && center < size)) return;  // it looks past its image, in which there is next to nothing
    const double reach = slope * focal_length + margin;
    const int first = std::max(0, int(std::floor(center - reach)));
    size = std::min(size, int(std::ceil(center + reach)) + 1) - first;
    center -= first;
  };
  crop(camera.width, camera.cx, camera.fx);
  crop(camera.height, camera.cy, camera.fy);
  return camera;
}

/// What renders the views of one mesh: loaded and made for the first of them and let go with the last, as of many
/// meshes that are trained one after the other each takes memory. Thread-safe.
class RendererOfViews {
public:
  RendererOfViews(std::function<std::shared_ptr<const Mesh>()> load, std::size_t views)
      : load_(std::move(load)), views_(views) {}

  std::shared_ptr<const Renderer> forView() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!renderer_) {
      const auto made = std::make_shared<Renderer>();
      made->addInstance(made->addMesh(load_()), Eigen::Isometry3d::Identity());
      renderer_ = made;
      rendered_ = 0;
    }
    const std::shared_ptr<const Renderer> renderer = renderer_;
    if (++rendered_ == views_) renderer_.reset();
    return renderer;
  }

private:
  std::function<std::shared_ptr<const Mesh>()> load_;
  std::size_t views_;
  std::mutex mutex_;
  std::shared_ptr<const Renderer> renderer_;
  std::size_t rendered_ = 0;
};

/// The points that were measured, in another frame.
Cloud measuredPoints(const Cloud& view, bool color, const Eigen::Isometry3d& T_model_camera) {
  const Eigen::Isometry3f transform = T_model_camera.cast<float>();
  Cloud cloud;
  cloud.sensor_origin = transform.translation();
  for (std::size_t i = 0; i < view.size(); ++i) {
    if (!view.points[i].allFinite()) continue;
    cloud.points.push_back(transform * view.points[i]);
    if (color) cloud.colors.push_back(view.colors[i]);
  }
  cloud.width = std::uint32_t(cloud.size());
  return cloud;
}

}  // namespace

Eigen::Isometry3d lookAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target, const Eigen::Vector3d& up) {
  const Eigen::Vector3d z = (target - eye).normalized();
  Eigen::Vector3d x = z.cross(up);
  if (x.norm() < 1e-6) x = z.unitOrthogonal();
  x.normalize();
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  T_world_camera.linear() << x, z.cross(x), z;
  T_world_camera.translation() = eye;
  return T_world_camera;
}

std::vector<TrainingSample> meshSamples(const std::string& object, const std::string& source,
                                        const std::shared_ptr<const Mesh>& mesh, const MeshTraining& training) {
  return meshSamples(
      object, source, *mesh, [mesh] { return mesh; }, training);
}

std::vector<TrainingSample> meshSamples(const std::string& object, const std::string& source, const Mesh& mesh,
                                        const std::function<std::shared_ptr<const Mesh>()>& load,
                                        const MeshTraining& training) {
  constexpr int most_views = 10000;
  if (training.views < 1 || training.views > most_views) {
    throw Error(ErrorCode::bad_usage, "views = " + std::to_string(training.views) + " must be in [1, 10000]");
  }
  constexpr double farthest = 100;
  if (!(training.distance > 0 && training.distance <= farthest)) {
    throw Error(ErrorCode::bad_usage,
                "the distance of the views, " + toText(training.distance) + " m, must be in (0, 100] m");
  }
  CameraModel camera = training.camera;
  if (!training.noise) camera.noise = CameraNoise::none();
  const Eigen::AlignedBox3f box = mesh.box();
  const double radius = 0.5 * double(box.diagonal().norm());
  const double distance = std::max(training.distance, fittingDistance(camera, radius));
  camera.min_range = 0;  // an object larger than usual is seen from as far as it needs
  camera.max_range = distance + 2 * radius;
  validate(camera);
  if (!training.noise) camera = croppedToBall(camera, radius, distance);  // errors are drawn pixel by pixel

  const std::vector<Eigen::Vector3d> directions = geodesicDirections(training.views);
  const auto renderer = std::make_shared<RendererOfViews>(load, directions.size());
  std::vector<TrainingSample> samples;
  for (const Eigen::Vector3d& direction : directions) {
    const std::size_t number = samples.size();
    const Eigen::Vector3d center = box.center().cast<double>();
    const Eigen::Isometry3d T_model_camera = lookAt(center + distance * direction, center, Eigen::Vector3d::UnitZ());
    TrainingSample sample;
    sample.object = object;
    sample.source = source + "#" + std::to_string(number);
    sample.frame = source;
    sample.box = box;
    sample.rendered = true;
    sample.load = [renderer, camera, T_model_camera, number, threads = training.threads, color = mesh.hasColor()] {
      const Rendering view = renderer->forView()->render(camera, T_model_camera, number, threads);
      return measuredPoints(view.cloud, color, T_model_camera);
    };
    samples.push_back(std::move(sample));
  }
  return samples;
}

}  // namespace sks
