// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/simulation/camera_presets.hpp>

#include "core/surface/color_space.hpp"
#include "error_of.hpp"
#include "simulation/color_errors.hpp"
#include "simulation/noise_field.hpp"
#include "simulation/renderer.hpp"
#include "simulation/shapes.hpp"

namespace sks {
namespace {

using ::testing::HasSubstr;

/// Mean product of values that lie `lag` columns apart.
double correlationAcross(const std::vector<float>& values, int width, int lag) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (int(i % std::size_t(width)) + lag >= width) continue;
    sum += double(values[i]) * double(values[i + std::size_t(lag)]);
    ++count;
  }
  return sum / double(count);
}

CameraModel smallCamera(CameraModel camera) {
  camera.width = 160;
  camera.height = 120;
  camera.cx = 79.5;
  camera.cy = 59.5;
  return camera;
}

/// A grey wall 1 m ahead.
Rendering wall(const CameraModel& camera, std::uint64_t frame, double lost = 0, int threads = 2) {
  Renderer renderer;
  const auto mesh = std::make_shared<const Mesh>(makeBox({4, 4, 0.1f}, plain({128, 128, 128})));
  renderer.addInstance(renderer.addMesh(mesh), Eigen::Isometry3d(Eigen::Translation3d(0, 0, 1.05)), lost);
  return renderer.render(camera, Eigen::Isometry3d::Identity(), frame, threads);
}

/// Deviations of the disparity from that of the wall [px].
std::vector<float> disparityErrors(const Rendering& view, const CameraModel& camera) {
  std::vector<float> errors;
  for (const Eigen::Vector3f& p : view.cloud.points) {
    errors.push_back(std::isfinite(p.z()) ? float(camera.fx * camera.baseline) * (1 / p.z() - 1) : 0.0f);
  }
  return errors;
}

TEST(NoiseField, HasUnitVarianceAndTheCorrelationOfItsKernel) {
  NoiseField field{320, 240, 2, 1, 5, 7, 0};
  const std::vector<float> values = field.values(2);
  EXPECT_NEAR(std::accumulate(values.begin(), values.end(), 0.0) / double(values.size()), 0, 0.05);
  EXPECT_NEAR(correlationAcross(values, 320, 0), 1, 0.06);
  EXPECT_NEAR(correlationAcross(values, 320, 2), std::exp(-4.0 / 16), 0.06);
  EXPECT_NEAR(correlationAcross(values, 320, 4), std::exp(-1.0), 0.06);
  EXPECT_NEAR(correlationAcross(values, 320, 16), 0, 0.06);
  EXPECT_EQ(field.values(1), values);
  field.stream = 1;
  EXPECT_NE(field.values(2), values);
}

TEST(CameraPresets, DepthErrorsAreThoseOfRecordings) {
  struct Measured {
    const char* camera;
    double deviation;    // of the disparity on planes [px]
    double correlation;  // of pixels four columns apart
  };
  for (const Measured& measured : {Measured{"kinect", 0.08, 0.3}, Measured{"realsense", 0.06, 0.85}}) {
    CameraModel camera = smallCamera(cameraPreset(measured.camera));
    camera.noise.edge_loss = 0;
    const std::vector<float> errors = disparityErrors(wall(camera, 0), camera);
    const double variance = correlationAcross(errors, camera.width, 0);
    EXPECT_NEAR(std::sqrt(variance), measured.deviation, 0.2 * measured.deviation) << measured.camera;
    EXPECT_NEAR(correlationAcross(errors, camera.width, 4) / variance, measured.correlation, 0.15) << measured.camera;
  }
  EXPECT_THAT(test::errorOf(ErrorCode::bad_usage, [] { cameraPreset("kinekt"); }),
              HasSubstr("no camera 'kinekt': use one of ideal, basic, kinect, xtion, realsense"));
}

TEST(CameraPresets, SameSeedSamePictureForAnyNumberOfThreads) {
  const CameraModel camera = smallCamera(cameraPreset("xtion"));
  const Rendering one = wall(camera, 3, 0.2, 1), two = wall(camera, 3, 0.2, 2), other = wall(camera, 4, 0.2, 2);
  const auto same = [](const Rendering& a, const Rendering& b) {
    for (std::size_t i = 0; i < a.cloud.size(); ++i) {
      const Rgb &c = a.cloud.colors[i], &d = b.cloud.colors[i];
      if (c.r != d.r || c.g != d.g || c.b != d.b) return false;
      if (a.cloud.points[i].allFinite() != b.cloud.points[i].allFinite()) return false;
      if (a.cloud.points[i].allFinite() && a.cloud.points[i] != b.cloud.points[i]) return false;
    }
    return true;
  };
  EXPECT_TRUE(same(one, two));
  EXPECT_FALSE(same(one, other));
}

TEST(CameraPresets, ColoursShiftAsFarAsRecordedOnes) {
  CameraModel camera = smallCamera(cameraPreset("kinect"));
  const auto grey = toScaledLab({128, 128, 128});
  float darkest = 0, brightest = 0, reddest = 0, bluest = 0;
  for (std::uint64_t frame = 0; frame < 12; ++frame) {
    const Rendering view = wall(camera, frame);
    const auto lab = toScaledLab(view.cloud.colors[60 * 160 + 80]);
    darkest = std::min(darkest, 100 * (lab[0] - grey[0]));
    brightest = std::max(brightest, 100 * (lab[0] - grey[0]));
    reddest = std::max(reddest, 120 * (lab[1] - grey[1]));
    bluest = std::min(bluest, 120 * (lab[2] - grey[2]));
  }
  EXPECT_LT(darkest, -15);
  EXPECT_GT(brightest, 0);
  EXPECT_GT(reddest, 4);
  EXPECT_LT(bluest, -6);
}

TEST(CameraErrors, OfColourComeOneByOne) {
  CameraModel camera = smallCamera(cameraPreset("ideal"));
  camera.color.min_exposure = camera.color.max_exposure = -1;
  EXPECT_NEAR(wall(camera, 0).cloud.colors[60 * 160 + 80].g, 92, 1);  // half the light of 128
  camera.color = {};
  camera.color.vignetting = 0.5;
  const Rendering vignetted = wall(camera, 0);
  EXPECT_NEAR(vignetted.cloud.colors[60 * 160 + 80].g, 128, 1);
  EXPECT_NEAR(vignetted.cloud.colors[0].g, 92, 2);
  camera.color = {};
  camera.color.noise_blue = 10;
  const Rendering noisy = wall(camera, 0);
  double squares = 0;
  for (const Rgb& c : noisy.cloud.colors) {
    EXPECT_EQ(c.r, 128);
    squares += std::pow(double(c.b) - 128, 2);
  }
  EXPECT_NEAR(std::sqrt(squares / double(noisy.cloud.size())), 10, 1);
}

TEST(CameraErrors, PartOfASurfaceGivesNoDepth) {
  CameraModel camera = smallCamera(cameraPreset("ideal"));
  camera.noise.grazing = true;
  const auto measured = [&](double lost) {
    const Cloud cloud = wall(camera, 0, lost).cloud;
    const auto count =
        std::count_if(cloud.points.begin(), cloud.points.end(), [](const Eigen::Vector3f& p) { return p.allFinite(); });
    return double(count) / double(cloud.size());
  };
  EXPECT_EQ(measured(0), 1);
  EXPECT_NEAR(measured(0.4), 0.6, 0.15);
}

TEST(CameraErrors, EdgesAreLost) {
  CameraModel camera = smallCamera(cameraPreset("ideal"));
  camera.noise.edge_loss = 3;
  Renderer renderer;
  const auto add = [&](const Eigen::Vector3f& size, double z) {
    renderer.addInstance(renderer.addMesh(std::make_shared<const Mesh>(makeBox(size, plain({})))),
                         Eigen::Isometry3d(Eigen::Translation3d(0, 0, z)));
  };
  add({4, 4, 0.1f}, 1.25);
  add({0.1f, 0.1f, 0.1f}, 0.75);  // its front reaches from column 41 to 117
  const Cloud cloud = renderer.render(camera, Eigen::Isometry3d::Identity(), 0, 2).cloud;
  const auto row = [&](int column) { return cloud.points[60 * 160 + std::size_t(column)]; };
  EXPECT_NEAR(row(79).z(), 0.7, 1e-3);
  EXPECT_NEAR(row(20).z(), 1.2, 1e-3);
  std::size_t lost = 0;
  for (int column = 20; column < 79; ++column) lost += row(column).allFinite() ? 0 : 1;
  EXPECT_GE(lost, 3u);
  EXPECT_LE(lost, 10u);
}

}  // namespace
}  // namespace sks
