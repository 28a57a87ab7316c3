// SPDX-License-Identifier: BSD-3-Clause
// The plane that objects stand on, in rendered scenes of a known table.
#include <sks_detector/support.hpp>

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/capture/smallest_rectangle.hpp"
#include "simulation/renderer.hpp"
#include "simulation/shapes.hpp"
#include "table_scene.hpp"

namespace sks::test {
namespace {

constexpr double degree = EIGEN_PI / 180;
const Eigen::Vector3d table_size(0.8, 0.5, 0.03), thing_size(0.08, 0.06, 0.12);

/// What stands or hangs around, in the frame of the table: the middle of its top, z up.
class SupportScene {
public:
  void addBox(const Eigen::Vector3d& size, const Eigen::Vector3d& center) {
    const auto mesh = std::make_shared<const Mesh>(makeBox(size.cast<float>(), plain({150, 140, 130}), 0.02f));
    renderer_.addInstance(renderer_.addMesh(mesh), Eigen::Isometry3d(Eigen::Translation3d(center)));
  }
  void addTableTop() { addBox(table_size, {0, 0, -0.5 * table_size.z()}); }
  /// A thing whose underside is at this place, and which is detected.
  void addThing(const Eigen::Vector3d& base) {
    const Eigen::Vector3d center = base + Eigen::Vector3d(0, 0, 0.5 * thing_size.z());
    addBox(thing_size, center);
    Detection detection;
    detection.T_scene_box = T_table_camera.inverse() * Eigen::Translation3d(center);
    detection.box_size = thing_size;
    detections.push_back(detection);
  }

  Cloud cloud(bool noise = true) const {
    CameraModel camera;
    if (!noise) camera.noise = CameraNoise::none();
    return renderer_.render(camera, T_table_camera, 1, 1).cloud;
  }
  std::optional<Support> support(bool noise = true) const { return findSupport(cloud(noise), detections); }

  Eigen::Isometry3d T_table_camera = cameraAt({0, 0, 0}, -70, 50 * degree, 1.1);
  std::vector<Detection> detections;

private:
  Renderer renderer_;
};

/// Normal within 1 degree, height within 3 mm, extents and middle within a few centimetres.
void expectTableTop(const SupportScene& scene, const Support& support, double height = 0,
                    const Eigen::Vector2d& size = table_size.head<2>()) {
  const Eigen::Isometry3d T_table_plane = scene.T_table_camera * support.T_scene_plane;
  EXPECT_LT(std::acos(std::min(1.0, T_table_plane.linear().col(2).z())) / degree, 1.0);
  EXPECT_NEAR(T_table_plane.translation().z(), height, 0.003);
  EXPECT_LT(T_table_plane.translation().head<2>().norm(), 0.03);
  EXPECT_NEAR(std::abs(T_table_plane.linear().col(0).x()), 1, 0.005) << "x is along the longer side";
  EXPECT_NEAR(support.size.x(), size.x(), 0.04);
  EXPECT_NEAR(support.size.y(), size.y(), 0.04);
  EXPECT_NEAR(T_table_plane.linear().determinant(), 1, 1e-6);
}

TEST(Support, IsTheTableThatThingsStandOn) {
  for (const bool noise : {false, true}) {
    SCOPED_TRACE(noise);
    SupportScene scene;
    scene.addTableTop();
    scene.addThing({0.1, 0.05, 0});
    scene.addThing({-0.2, -0.1, 0});
    const auto support = scene.support(noise);
    ASSERT_TRUE(support);
    expectTableTop(scene, *support);
    EXPECT_EQ(support->standing, 2u);
  }
}

TEST(Support, HasItsOutlineInItsOwnFrame) {
  SupportScene scene;
  scene.addTableTop();
  const auto support = scene.support();
  ASSERT_TRUE(support);
  expectTableTop(scene, *support);
  EXPECT_EQ(support->standing, 0u);
  ASSERT_GE(support->outline.size(), 4u);
  double twice_area = 0;
  Eigen::AlignedBox2d box;
  for (std::size_t i = 0; i < support->outline.size(); ++i) {
    const Eigen::Vector2d &a = support->outline[i], &b = support->outline[(i + 1) % support->outline.size()];
    twice_area += a.x() * b.y() - a.y() * b.x();
    box.extend(a);
  }
  EXPECT_NEAR(0.5 * twice_area, 0.4, 0.04) << "counter-clockwise";
  EXPECT_TRUE(box.sizes().isApprox(support->size, 1e-3)) << box.sizes().transpose();
  EXPECT_LT(box.center().norm(), 1e-3);
}

TEST(Support, IsNotALargerFloorOrWallWhereThingsStandOnATable) {
  SupportScene scene;
  scene.addTableTop();
  scene.addBox({4, 4, 0.02}, {0, 0, -0.5});
  scene.addBox({4, 0.02, 3}, {0, 1.2, 0});
  scene.addThing({0.1, 0, 0});
  const auto support = scene.support();
  ASSERT_TRUE(support);
  expectTableTop(scene, *support);
  EXPECT_EQ(support->standing, 1u);

  scene.detections.clear();
  const auto largest = scene.support();
  ASSERT_TRUE(largest);
  EXPECT_GT(largest->size.maxCoeff(), 1.2);
}

TEST(Support, IsFoundFromNearAndFarBeforeFloorAndWall) {
  for (const double elevation : {25, 45, 80}) {
    for (const double distance : {0.8, 2.0}) {
      SCOPED_TRACE(testing::Message() << elevation << " degrees, " << distance << " m");
      SupportScene scene;
      scene.T_table_camera = cameraAt({0, 0, 0}, -70, elevation * degree, distance);
      scene.addTableTop();
      scene.addBox({3, 3, 0.02}, {0, 0, -0.5});
      scene.addBox({3, 0.02, 2}, {0, 1.2, 0});
      scene.addThing({0.1, 0, 0});
      const auto support = scene.support();
      ASSERT_TRUE(support);
      expectTableTop(scene, *support);
      EXPECT_EQ(support->standing, 1u);
    }
  }
}

TEST(Support, EndsAtAWallBehindIt) {
  SupportScene scene;
  scene.addTableTop();
  scene.addBox({3, 0.02, 1}, {0, 0.5 * table_size.y() + 0.01, 0.3});  // farther to both sides than the table
  scene.addThing({0.1, 0, 0});
  const auto support = scene.support();
  ASSERT_TRUE(support);
  expectTableTop(scene, *support);
}

TEST(Support, IsAShelfThatMostThingsStandOn) {
  SupportScene scene;
  scene.addTableTop();
  const Eigen::Vector3d shelf(0.3, 0.25, 0.1);
  scene.addBox(shelf, {0, 0.05, 0.05});
  scene.addThing({0.05, 0.05, 0.1});
  scene.addThing({-0.08, 0.08, 0.1});
  scene.addThing({0.3, -0.1, 0});
  const auto support = scene.support();
  ASSERT_TRUE(support);
  EXPECT_EQ(support->standing, 2u);
  EXPECT_NEAR((scene.T_table_camera * support->T_scene_plane).translation().z(), 0.1, 0.003);
  EXPECT_NEAR(support->size.x(), shelf.x(), 0.04);
  EXPECT_NEAR(support->size.y(), shelf.y(), 0.04);
}

TEST(Support, IsNotAFrameThatLiesAroundThings) {
  SupportScene scene;
  scene.addTableTop();
  for (const double x : {-0.25, 0.25}) scene.addBox({0.3, 0.5, 0.015}, {x, 0, 0.0075});
  scene.addBox({0.8, 0.1, 0.015}, {0, 0.2, 0.0075});
  scene.addThing({0, 0, 0});
  const auto support = scene.support();
  ASSERT_TRUE(support);
  EXPECT_NEAR((scene.T_table_camera * support->T_scene_plane).translation().z(), 0, 0.003);
  EXPECT_EQ(support->standing, 1u);
}

TEST(Support, OfALyingRoundThingIsFoundThoughItsBoxIsTurned) {
  SupportScene scene;
  scene.addTableTop();
  scene.addThing({0.1, 0, 0});
  scene.detections[0].T_scene_box.rotate(Eigen::AngleAxisd(45 * degree, Eigen::Vector3d::UnitX()));
  const auto support = scene.support();
  ASSERT_TRUE(support);
  expectTableTop(scene, *support);
  EXPECT_EQ(support->standing, 1u);
}

TEST(Support, IsTheSameInAnyFrame) {
  SupportScene scene;
  scene.addTableTop();
  scene.addThing({0.1, 0.05, 0});
  Cloud cloud = scene.cloud();
  const Eigen::Isometry3f T = scene.T_table_camera.cast<float>();
  for (auto& p : cloud.points) p = T * p;
  cloud.sensor_origin = T.translation();
  cloud.width = 0;
  cloud.height = 1;
  for (Detection& detection : scene.detections) detection.T_scene_box = scene.T_table_camera * detection.T_scene_box;
  const auto support = findSupport(cloud, scene.detections);
  ASSERT_TRUE(support);
  scene.T_table_camera.setIdentity();
  expectTableTop(scene, *support);
  EXPECT_EQ(support->standing, 1u);
}

TEST(Support, LeavesOutWhatTheSettingsLeaveOut) {
  SupportScene scene;
  scene.addTableTop();
  SanitizeSettings settings;
  settings.max_range = 0.5;
  EXPECT_FALSE(findSupport(scene.cloud(), {}, settings));
}

TEST(Support, IsMissingWhereNothingIsFlatAndLarge) {
  EXPECT_FALSE(findSupport(Cloud(), {}));
  Cloud unmeasured;
  unmeasured.points.assign(1000, Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  EXPECT_FALSE(findSupport(unmeasured, {}));
  SupportScene small;
  small.addThing({0, 0, 0});
  EXPECT_FALSE(small.support());
}

TEST(SmallestRectangle, LiesAlongTheSidesOfATurnedOne) {
  const Eigen::Rotation2Df turn(0.3f);
  std::vector<Eigen::Vector2f> corners;
  for (const Eigen::Vector2f& p : {Eigen::Vector2f(-1, -2), {1, -2}, {1, 2}, {-1, 2}, {0, 0}}) {
    corners.push_back(turn * p + Eigen::Vector2f(5, 6));
  }
  const Rectangle rectangle = smallestRectangle(ConvexPolygon(corners));
  EXPECT_NEAR(rectangle.length, 4, 1e-4);
  EXPECT_NEAR(rectangle.width, 2, 1e-4);
  EXPECT_TRUE(rectangle.center.isApprox(Eigen::Vector2f(5, 6), 1e-4f));
  EXPECT_NEAR(std::abs(rectangle.long_axis.dot(turn * Eigen::Vector2f::UnitY())), 1, 1e-4);
}

}  // namespace
}  // namespace sks::test
