// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/twin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <sks_detector/error.hpp>

#include "core/surface/pinhole_fit.hpp"
#include "simulation/color_errors.hpp"
#include "simulation/renderer.hpp"

namespace sks {
namespace {

constexpr float in_front = 0.02f;         // a recorded point so much before a mesh hides it [m]
constexpr float same_thing = 0.015f;      // recorded points beside a mesh, so near to its depth, are of the object [m]
constexpr int rim = 2;                    // how far beside the mesh they are looked for [px]
constexpr std::size_t least_colors = 50;  // pixels, to fit exposure and white balance

/// The points that were measured, with their pixels.
Cloud measuredOf(const Cloud& recording) {
  Cloud measured;
  measured.columns = recording.width;
  for (std::size_t i = 0; i < recording.size(); ++i) {
    if (!recording.points[i].allFinite()) continue;
    measured.points.push_back(recording.points[i]);
    measured.pixels.push_back(std::uint32_t(i));
  }
  return measured;
}

/// The camera of a recording with the errors of another one, whose lengths in pixels grow with the focal length.
CameraModel cameraOf(const Cloud& recording, CameraModel camera, int threads) {
  if (!recording.organized()) {
    throw Error(ErrorCode::bad_data, "a twin needs an organised cloud: record depth pictures, not unordered points");
  }
  const std::optional<Pinhole> pinhole = fitPinhole(measuredOf(recording), threads);
  if (!pinhole) throw Error(ErrorCode::bad_data, "no pinhole camera sees the cloud's points at their pixels");
  const double ratio = pinhole->focal_x / camera.fx;
  camera.width = int(recording.width);
  camera.height = int(recording.height);
  camera.fx = pinhole->focal_x;
  camera.fy = pinhole->focal_y;
  camera.cx = pinhole->center_x;
  camera.cy = pinhole->center_y;
  CameraNoise& noise = camera.noise;
  for (double* length : {&noise.lateral_sigma, &noise.disparity_step, &noise.disparity_sigma, &noise.correlation_x,
                         &noise.correlation_y, &noise.edge_loss, &camera.color.offset, &camera.color.blur}) {
    *length *= ratio;
  }
  return camera;
}

double medianOf(std::vector<double>& values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Sets exposure and white balance to those of a recording: the medians over what both see.
void fitColors(const Cloud& recording, const Rendering& exact, const std::vector<char>& on_object, ColorErrors& color) {
  std::array<std::vector<double>, 3> stops;
  for (std::size_t pixel = 0; pixel < on_object.size(); ++pixel) {
    if (!on_object[pixel] || !recording.points[pixel].allFinite()) continue;
    const Eigen::Vector3f seen = toLinear(recording.colors[pixel]), true_light = toLinear(exact.cloud.colors[pixel]);
    for (std::size_t c = 0; c < 3; ++c) {
      constexpr float dark = 0.005f, bright = 0.95f;
      const float a = seen[Eigen::Index(c)], b = true_light[Eigen::Index(c)];
      if (a > dark && b > dark && a < bright && b < bright) stops[c].push_back(std::log2(double(a / b)));
    }
  }
  for (const std::vector<double>& of_channel : stops) {
    if (of_channel.size() < least_colors) return;
  }
  const double red = medianOf(stops[0]), green = medianOf(stops[1]), blue = medianOf(stops[2]);
  color.min_exposure = color.max_exposure = green;
  color.min_red = color.max_red = red - green;
  color.min_blue = color.max_blue = blue - green;
}

/// Whether a recorded point that lies beside the meshes is one of an object after all.
bool isRim(const Cloud& recording, const Rendering& exact, const std::vector<char>& on_object, int row, int column) {
  const int width = int(recording.width), height = int(recording.height);
  const float depth = recording.points[std::size_t(row) * std::size_t(width) + std::size_t(column)].z();
  for (int y = std::max(0, row - rim); y <= std::min(height - 1, row + rim); ++y) {
    for (int x = std::max(0, column - rim); x <= std::min(width - 1, column + rim); ++x) {
      const std::size_t pixel = std::size_t(y) * std::size_t(width) + std::size_t(x);
      if (on_object[pixel] && std::abs(exact.cloud.points[pixel].z() - depth) < same_thing) return true;
    }
  }
  return false;
}

}  // namespace

Twin makeTwin(const Cloud& recording, const std::vector<TwinObject>& objects, const CameraModel& camera,
              std::uint64_t frame, int threads) {
  CameraModel used = cameraOf(recording, camera, threads);
  Renderer renderer;
  for (const TwinObject& object : objects) renderer.addInstance(renderer.addMesh(object.mesh), object.T_camera_mesh);
  CameraModel ideal = used;
  ideal.noise = CameraNoise::none();
  ideal.noise.seed = used.noise.seed;
  ideal.color = {};
  ideal.color.light = used.color.light;  // so that exposure is fitted to what the same light shows
  const Rendering exact = renderer.render(ideal, Eigen::Isometry3d::Identity(), frame, threads);
  std::vector<char> on_object(recording.size(), 0);
  for (std::size_t i = 0; i < recording.size(); ++i) {
    const float seen = recording.points[i].z(), depth = exact.cloud.points[i].z();
    on_object[i] = exact.instance[i] >= 0 && std::isfinite(depth) && !(seen < depth - in_front) ? 1 : 0;
  }
  if (recording.hasColor() && used.color.any()) fitColors(recording, exact, on_object, used.color);
  const Rendering view = renderer.render(used, Eigen::Isometry3d::Identity(), frame, threads);

  Twin twin{recording, std::vector<std::size_t>(objects.size(), 0)};
  for (int row = 0; row < used.height; ++row) {
    for (int column = 0; column < used.width; ++column) {
      const std::size_t i = std::size_t(row) * std::size_t(used.width) + std::size_t(column);
      Eigen::Vector3f& point = twin.cloud.points[i];
      if (!on_object[i]) {
        if (point.allFinite() && isRim(recording, exact, on_object, row, column)) {
          point.setConstant(std::numeric_limits<float>::quiet_NaN());
        }
        continue;
      }
      point = view.cloud.points[i];
      if (twin.cloud.hasColor()) twin.cloud.colors[i] = view.cloud.colors[i];
      twin.points[std::size_t(exact.instance[i])] += point.allFinite() ? 1 : 0;
    }
  }
  return twin;
}

}  // namespace sks
