// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/renderer.hpp"

#include <cmath>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.hpp"
#include "simulation/shapes.hpp"

namespace sks {
namespace {

using ::testing::HasSubstr;

CameraModel noiseless() {
  CameraModel camera;
  camera.noise = CameraNoise::none();
  return camera;
}

Eigen::Isometry3d at(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

std::shared_ptr<const Mesh> share(Mesh mesh) {
  return std::make_shared<const Mesh>(std::move(mesh));
}

/// A wall across the camera's view.
Renderer wallAt(double depth, Eigen::Isometry3d turn = Eigen::Isometry3d::Identity()) {
  Renderer renderer;
  const std::size_t wall = renderer.addMesh(share(makeBox({20, 20, 0.1f}, plain({10, 20, 30}))));
  renderer.addInstance(wall, at(0, 0, depth) * turn * at(0, 0, 0.05));
  return renderer;
}

std::vector<double> finiteDepths(const Rendering& rendering) {
  std::vector<double> depths;
  for (const float z : rendering.depth()) {
    if (std::isfinite(z)) depths.push_back(z);
  }
  return depths;
}

double deviation(const std::vector<double>& values) {
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
  double sum = 0;
  for (const double v : values) sum += (v - mean) * (v - mean);
  return std::sqrt(sum / double(values.size()));
}

TEST(Renderer, SphereHasItsAnalyticDepth) {
  Renderer renderer;
  const double radius = 0.12;
  const Eigen::Vector3d center(0.05, -0.03, 1);
  renderer.addInstance(renderer.addMesh(share(makeSphere(float(radius), 7, plain({1, 2, 3})))),
                       at(center.x(), center.y(), center.z()));
  const Rendering view = renderer.render(noiseless(), Eigen::Isometry3d::Identity(), 0, 2);
  std::size_t compared = 0;
  for (std::size_t i = 0; i < view.cloud.size(); ++i) {
    const Eigen::Vector3d ray = noiseless().ray(double(i % 640), double(i / 640)).cast<double>();
    const double a = ray.squaredNorm(), b = ray.dot(center), c = center.squaredNorm() - radius * radius;
    const double root = b * b - a * c;
    if (root < 0) {
      EXPECT_EQ(view.instance[i], -1) << i;
      continue;
    }
    const double depth = (b - std::sqrt(root)) / a;
    const double cosine = std::abs((depth * ray - center).dot(ray)) / (radius * ray.norm());
    if (cosine < 0.3) continue;  // at the rim the facets' height counts many times
    ++compared;
    ASSERT_NEAR(view.cloud.points[i].z(), depth, 1e-5);
    ASSERT_EQ(view.instance[i], 0);
    ASSERT_EQ(view.cloud.colors[i].b, 3);
  }
  EXPECT_GT(compared, 10000u);
}

TEST(Renderer, TurnedBoxHasItsAnalyticDepth) {
  const Eigen::Vector3d size(0.3, 0.2, 0.4);
  Eigen::Isometry3d T_world_box = at(0.1, 0.05, 1.2);
  T_world_box.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  Eigen::Isometry3d T_world_camera = at(0.02, -0.1, 0.1);
  T_world_camera.rotate(Eigen::AngleAxisd(0.1, Eigen::Vector3d(3, 1, 0.2).normalized()));
  Renderer renderer;
  renderer.addInstance(renderer.addMesh(share(makeBox(size.cast<float>(), plain({})))), T_world_box);
  const Rendering view = renderer.render(noiseless(), T_world_camera, 0, 2);
  const Eigen::Isometry3d T_box_camera = T_world_box.inverse() * T_world_camera;
  std::size_t compared = 0;
  for (std::size_t i = 0; i < view.cloud.size(); ++i) {
    const Eigen::Vector3d origin = T_box_camera.translation();
    const Eigen::Vector3d ray =
        T_box_camera.linear() * noiseless().ray(double(i % 640), double(i / 640)).cast<double>();
    double enter = -1e9, leave = 1e9;  // slabs
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (-size[axis] / 2 - origin[axis]) / ray[axis], b = (size[axis] / 2 - origin[axis]) / ray[axis];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    if (leave - enter < 1e-4) continue;  // misses it, or grazes an edge
    ++compared;
    ASSERT_NEAR(view.cloud.points[i].z(), enter, 1e-5);
  }
  EXPECT_GT(compared, 20000u);
}

TEST(Renderer, InsideOutAndOpenMeshesAreSeen) {
  Mesh sheet;
  sheet.vertices = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  for (const Eigen::Vector3i& corners : {Eigen::Vector3i(0, 1, 2), Eigen::Vector3i(0, 2, 1)}) {
    sheet.triangles = {corners};
    Renderer renderer;
    renderer.addInstance(renderer.addMesh(share(sheet)), at(0, 0, 1));
    CameraModel camera;
    camera.noise.axial = camera.noise.lateral = camera.noise.disparity = false;  // grazing angles stay on
    const Rendering view = renderer.render(camera, Eigen::Isometry3d::Identity(), 0, 1);
    EXPECT_FLOAT_EQ(view.cloud.points[240 * 640 + 320].z(), 1);
  }
}

TEST(Renderer, AxialNoiseFollowsTheModel) {
  for (const double depth : {0.8, 1.5, 3.0}) {
    for (const bool disparity : {false, true}) {
      CameraModel camera;
      camera.noise.disparity = disparity;
      camera.noise.lateral = camera.noise.shadow = false;
      const Rendering view = wallAt(depth).render(camera, Eigen::Isometry3d::Identity(), 0, 2);
      const double expected = 0.0012 + 0.0019 * (depth - 0.4) * (depth - 0.4);
      EXPECT_NEAR(deviation(finiteDepths(view)), expected, 0.1 * expected) << depth << " m, steps: " << disparity;
    }
  }
}

TEST(Renderer, LateralNoiseMovesDepthAcrossTheImage) {
  CameraModel camera = noiseless();
  camera.noise.lateral = true;
  const Eigen::Isometry3d turn(Eigen::AngleAxisd(EIGEN_PI / 4, Eigen::Vector3d::UnitY()));
  const Renderer renderer = wallAt(1, turn);
  const Rendering exact = renderer.render(noiseless(), Eigen::Isometry3d::Identity(), 0, 2);
  const Rendering noisy = renderer.render(camera, Eigen::Isometry3d::Identity(), 0, 2);
  std::vector<double> errors;
  for (int row = 0; row < 480; ++row) {  // the columns in the middle, where z = 1 - x: |dz| = dx = z / f px / (1 + x/z)
    const std::size_t i = std::size_t(row) * 640 + 320;
    errors.push_back(double(noisy.cloud.points[i].z()) - double(exact.cloud.points[i].z()));
  }
  EXPECT_NEAR(deviation(errors), 0.8 / 525, 0.1 * 0.8 / 525);
}

TEST(Renderer, DisparityComesInSteps) {
  CameraModel camera = noiseless();
  camera.noise.disparity = true;
  const Eigen::Isometry3d turn(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitY()));
  for (const double depth : finiteDepths(wallAt(1, turn).render(camera, Eigen::Isometry3d::Identity(), 0, 2))) {
    const double steps = 8 * 525 * 0.075 / depth;
    ASSERT_NEAR(steps, std::round(steps), 1e-3);
  }
}

TEST(Renderer, SurfacesAtASlantLoseDepth) {
  CameraModel camera = noiseless();
  camera.noise.grazing = true;
  const auto shareSeen = [&](double degrees) {
    const Eigen::Isometry3d turn(Eigen::AngleAxisd(degrees * EIGEN_PI / 180, Eigen::Vector3d::UnitX()));
    const Rendering view = wallAt(1, turn).render(camera, Eigen::Isometry3d::Identity(), 0, 2);
    int seen = 0;
    for (int column = 0; column < 640; ++column) {  // the row in the middle, seen under this angle or a little more
      seen += std::isfinite(view.cloud.points[std::size_t(240 * 640 + column)].z());
    }
    return seen / 640.0;
  };
  EXPECT_EQ(shareSeen(50), 1);
  EXPECT_GT(shareSeen(74), 0.2);
  EXPECT_LT(shareSeen(74), 0.8);
  EXPECT_EQ(shareSeen(82), 0);
}

TEST(Renderer, ProjectorsShadowIsOnTheLeft) {
  Renderer renderer;
  renderer.addInstance(renderer.addMesh(share(makeBox({20, 20, 0.1f}, plain({})))), at(0, 0, 1.55));
  renderer.addInstance(renderer.addMesh(share(makeBox({0.2f, 0.2f, 0.02f}, plain({})))), at(0, 0, 0.81));
  CameraModel camera = noiseless();
  camera.noise.shadow = true;
  const Rendering view = renderer.render(camera, Eigen::Isometry3d::Identity(), 0, 2);
  const auto shadowOf = [&](int from, int to) {
    int lost = 0;
    for (int column = from; column < to; ++column)
      lost += std::isnan(view.cloud.points[240 * 640 + std::size_t(column)].z());
    return lost;
  };
  // disparities: 525 * 0.075 / 0.8 = 49.2 px in front, 26.3 px behind
  EXPECT_NEAR(shadowOf(0, 320), 49.2 - 26.3, 2);
  EXPECT_EQ(shadowOf(320, 640), 0);
}

TEST(Renderer, NothingOutsideItsRange) {
  const CameraModel camera = noiseless();
  for (const double depth : {0.39, 4.01}) {
    EXPECT_TRUE(finiteDepths(wallAt(depth).render(camera, Eigen::Isometry3d::Identity(), 0, 2)).empty()) << depth;
  }
}

TEST(Renderer, SameSeedSameBytesForAnyNumberOfThreads) {
  const Eigen::Isometry3d turn(Eigen::AngleAxisd(0.8, Eigen::Vector3d::UnitX()));
  const Renderer renderer = wallAt(1, turn);
  const auto bytes = [&](std::uint64_t seed, std::uint64_t frame, int threads) {
    CameraModel camera;
    camera.noise.seed = seed;
    const std::vector<float> depth = renderer.render(camera, Eigen::Isometry3d::Identity(), frame, threads).depth();
    return std::string(reinterpret_cast<const char*>(depth.data()), depth.size() * sizeof(float));
  };
  const std::string first = bytes(7, 3, 1);
  EXPECT_EQ(first, bytes(7, 3, 1));
  EXPECT_EQ(first, bytes(7, 3, 2));
  EXPECT_NE(first, bytes(8, 3, 2));
  EXPECT_NE(first, bytes(7, 4, 2));
}

TEST(Renderer, HiddenInstancesAreNotSeen) {
  Renderer renderer = wallAt(1);
  renderer.setVisible(0, false);
  EXPECT_TRUE(finiteDepths(renderer.render(noiseless(), Eigen::Isometry3d::Identity(), 0, 2)).empty());
  renderer.setVisible(0, true);
  EXPECT_EQ(finiteDepths(renderer.render(noiseless(), Eigen::Isometry3d::Identity(), 0, 2)).size(), 640u * 480u);
}

TEST(CameraModel, RefusesWhatIsNoCamera) {
  const auto refusal = [](auto change) {
    CameraModel camera;
    change(camera);
    return test::errorOf(ErrorCode::bad_usage, [&] { validate(camera); });
  };
  EXPECT_THAT(refusal([](CameraModel& c) { c.width = 0; }), HasSubstr("camera: width = 0"));
  EXPECT_THAT(refusal([](CameraModel& c) { c.fx = -1; }), HasSubstr("fx = -1"));
  EXPECT_THAT(refusal([](CameraModel& c) { c.max_range = 0.1; }), HasSubstr("max_range"));
  EXPECT_THAT(refusal([](CameraModel& c) { c.baseline = 0; }), HasSubstr("baseline"));
}

}  // namespace
}  // namespace sks
