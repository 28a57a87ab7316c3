// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/simulation/camera_presets.hpp>

#include <sks_detector/error.hpp>

namespace sks {
namespace {

/// What differs between the pictures of one camera: at true poses, meshes and recordings differ in lightness by -30 to
/// +25, in a* by up to +12, in b* by up to -14.
ColorErrors anyLight() {
  ColorErrors color;
  color.min_exposure = -1.7;
  color.max_exposure = 1.2;
  color.min_red = -0.1;
  color.max_red = 0.35;
  color.min_blue = -0.1;
  color.max_blue = 0.55;
  color.light = 0.5;
  color.vignetting = 0.25;
  color.blur = 0.6;
  color.offset = 1.5;
  return color;
}

void setNoise(ColorErrors& color, double red, double green, double blue) {
  color.noise_red = red;
  color.noise_green = green;
  color.noise_blue = blue;
}

/// Structured light: smooth errors of the disparity, then steps of an eighth of a pixel.
CameraNoise structuredLight() {
  CameraNoise noise;
  noise.disparity_sigma = 0.07;
  noise.correlation_x = noise.correlation_y = 2;
  noise.lateral_sigma = 1;
  noise.dark = true;
  return noise;
}

CameraModel kinect() {
  CameraModel camera;
  camera.fx = camera.fy = 572;
  camera.noise = structuredLight();
  camera.color = anyLight();
  setNoise(camera.color, 1.5, 1.5, 1.5);
  return camera;
}

CameraModel xtion() {
  CameraModel camera;
  camera.fx = camera.fy = 540;
  camera.noise = structuredLight();
  camera.noise.disparity_sigma = 0.04;
  camera.noise.edge_loss = 2.5;
  camera.color = anyLight();
  setNoise(camera.color, 8, 8, 15);
  return camera;
}

/// Stereo: finer but longer waves, no steps but those of millimetres, shadows beside every edge.
CameraModel realsense() {
  CameraModel camera;
  camera.fx = camera.fy = 615;
  camera.baseline = 0.05;
  camera.min_range = 0.28;
  camera.noise.disparity = false;
  camera.noise.disparity_sigma = 0.06;
  camera.noise.correlation_x = 5;
  camera.noise.correlation_y = 3;
  camera.noise.depth_step = 0.001;
  camera.noise.edge_loss = 1;
  camera.noise.dark = true;
  camera.color = anyLight();
  setNoise(camera.color, 1.5, 1.5, 1.5);
  return camera;
}

CameraModel ideal() {
  CameraModel camera;
  camera.noise = CameraNoise::none();
  return camera;
}

CameraModel basic() {
  return {};
}

struct Preset {
  const char* name;
  CameraModel (*make)();
};
constexpr Preset presets[] = {
    {"ideal", ideal}, {"basic", basic}, {"kinect", kinect}, {"xtion", xtion}, {"realsense", realsense}};

}  // namespace

CameraModel cameraPreset(const std::string& name) {
  std::string known;
  for (const Preset& preset : presets) {
    if (name == preset.name) return preset.make();
    known += (known.empty() ? "" : ", ") + std::string(preset.name);
  }
  throw Error(ErrorCode::bad_usage, "there is no camera '" + name + "': use one of " + known);
}

}  // namespace sks
