// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "bumps.hpp"
#include "drawing/picture.hpp"
#include "drawing/point_image.hpp"
#include "error_of.hpp"
#include "io/file.hpp"
#include "io/image_file.hpp"
#include "temporary_folder.hpp"

namespace sks {
namespace {

constexpr Rgb magenta{255, 0, 255};

/// A square of 0.4 m across the z axis.
Cloud square(float z, Rgb color) {
  Cloud cloud;
  for (float x = -0.2f; x <= 0.2f; x += 0.005f) {
    for (float y = -0.2f; y <= 0.2f; y += 0.005f) {
      cloud.points.emplace_back(x, y, z);
      cloud.colors.push_back(color);
    }
  }
  cloud.width = std::uint32_t(cloud.points.size());
  return cloud;
}

void append(Cloud& cloud, const Cloud& other) {
  cloud.points.insert(cloud.points.end(), other.points.begin(), other.points.end());
  cloud.colors.insert(cloud.colors.end(), other.colors.begin(), other.colors.end());
  cloud.width = std::uint32_t(cloud.points.size());
}

Rgb at(const ColorImage& image, const Eigen::Vector2d& pixel) {
  return image(int(std::lround(pixel.y())), int(std::lround(pixel.x())));
}

bool same(const Rgb& a, const Rgb& b) {
  return a.r == b.r && a.g == b.g && a.b == b.b;
}

std::size_t count(const ColorImage& image, Rgb color) {
  return std::size_t(
      std::count_if(image.pixels.begin(), image.pixels.end(), [&](const Rgb& pixel) { return same(pixel, color); }));
}

ColorImage saved(const Picture& picture) {
  const test::TemporaryFolder folder;
  picture.save(folder.path("p.png"));
  return readColorImage(folder.path("p.png"));
}

}  // namespace

TEST(ViewCamera, LooksFromTheSensorAndFitsThePoints) {
  const PictureSize size{400, 300};
  const ViewCamera camera(square(1, magenta), size);
  EXPECT_TRUE(camera.toCamera({0.1, 0.05, 1}).isApprox(Eigen::Vector3d(0.1, 0.05, 1)));
  const Eigen::Vector2d low = camera.pixel(camera.toCamera({-0.2, -0.2, 1}));
  const Eigen::Vector2d high = camera.pixel(camera.toCamera({0.2, 0.2, 1}));
  EXPECT_NEAR(0.5 * (low.x() + high.x()), 200, 3);
  EXPECT_NEAR(0.5 * (low.y() + high.y()), 150, 3);
  EXPECT_NEAR(high.y() - low.y(), 0.94 * 300, 6);
  EXPECT_NEAR(high.x() - low.x(), high.y() - low.y(), 6);
  EXPECT_TRUE(camera.ray(low.x(), low.y()).isApprox(Eigen::Vector3d(-0.2, -0.2, 1), 1e-6));
}

TEST(ViewCamera, FollowsTheConventionOfTheCloud) {
  // Camera that looks along -z: x right, y up.
  const ViewCamera graphics(square(-1, magenta), {400, 300});
  const Eigen::Vector2d up = graphics.pixel(graphics.toCamera({0, 0.1, -1}));
  const Eigen::Vector2d right = graphics.pixel(graphics.toCamera({0.1, 0, -1}));
  const Eigen::Vector2d middle = graphics.pixel(graphics.toCamera({0, 0, -1}));
  EXPECT_LT(up.y(), middle.y() - 10);
  EXPECT_GT(right.x(), middle.x() + 10);

  // Sensor elsewhere, looking along -x.
  Cloud cloud = square(0, magenta);
  cloud.sensor_origin = {2, 0, 0.1f};
  const ViewCamera elsewhere(cloud, {400, 300});
  EXPECT_NEAR(elsewhere.toCamera(Eigen::Vector3d::Zero()).z(), Eigen::Vector3d(2, 0, 0.1).norm(), 0.01);

  // A full model around the origin is seen from outside.
  Cloud model = square(0.1f, magenta);
  append(model, square(-0.1f, magenta));
  const ViewCamera outside(model, {400, 300});
  for (const Eigen::Vector3f& point : model.points) EXPECT_GT(outside.toCamera(point.cast<double>()).z(), 0.1);
}

TEST(PointImage, NearPointsHideFarOnes) {
  const Rgb red{200, 10, 10}, green{10, 200, 10};
  Cloud cloud = square(1, red);
  append(cloud, square(1.5f, green));
  const PictureSize size{400, 300};
  const ViewCamera camera(cloud, size);
  const ColorImage image = renderPoints(cloud, camera, size);
  EXPECT_TRUE(same(at(image, camera.pixel(camera.toCamera({0, 0, 1.5}))), red));
  EXPECT_EQ(count(image, green), 0u);
  EXPECT_GT(count(image, red), 70000u);  // no holes
}

TEST(PointImage, WithoutColourSlopesAreDarker) {
  Cloud cloud;
  for (float x = -0.2f; x <= 0.2f; x += 0.002f) {
    for (float y = -0.2f; y <= 0.2f; y += 0.002f) cloud.points.emplace_back(x, y, x < 0 ? 1.0f : 1.0f + 2 * x);
  }
  cloud.width = std::uint32_t(cloud.points.size());
  const PictureSize size{400, 300};
  const ViewCamera camera(cloud, size);
  const ColorImage image = renderPoints(cloud, camera, size);
  const Rgb flat = at(image, camera.pixel(camera.toCamera({-0.1, 0, 1})));
  const Rgb slope = at(image, camera.pixel(camera.toCamera({0.05, 0, 1.1})));
  EXPECT_GT(flat.g, slope.g + 30);
}

TEST(PointImage, CloudsWithoutAPointGiveTheBackground) {
  Cloud cloud;
  cloud.points.emplace_back(std::nanf(""), 0, 0);
  cloud.width = 1;
  for (const Cloud& each : {Cloud(), cloud}) {
    const ColorImage image = renderPoints(each, ViewCamera(each, {40, 30}), {40, 30});
    EXPECT_TRUE(same(image(15, 20), image(0, 0)));
  }
}

TEST(Picture, DrawsBoxAxesAndLabelWhereTheyBelong) {
  const Cloud cloud = square(1, {200, 200, 200});
  Detection detection;
  detection.object = "mario";
  detection.score = 0.875;
  detection.T_scene_box.translation() = Eigen::Vector3d(0.05, 0, 1);
  detection.box_size = Eigen::Vector3d(0.1, 0.2, 0.001);
  Picture picture(cloud, {800, 600});
  picture.drawDetection(detection, magenta);
  const ColorImage image = saved(picture);
  const ViewCamera camera(cloud, {800, 600});
  for (const double side : {-0.05, 0.05}) {
    EXPECT_TRUE(same(at(image, camera.pixel({0.05 + side, 0.03, 1})), magenta));
    EXPECT_TRUE(same(at(image, camera.pixel({0.05, 2 * side, 1})), magenta));
  }
  const Rgb x_axis = at(image, camera.pixel({0.08, 0, 1})), y_axis = at(image, camera.pixel({0.05, 0.05, 1}));
  EXPECT_TRUE(x_axis.r > 200 && x_axis.b < 100) << int(x_axis.r) << " " << int(x_axis.b);
  EXPECT_TRUE(y_axis.g > 200 && y_axis.r < 100) << int(y_axis.g) << " " << int(y_axis.r);
  const Eigen::Vector2d above = camera.pixel({0.05, -0.1, 1}) - Eigen::Vector2d(0, 10);
  EXPECT_TRUE(same(at(image, above), magenta));  // the label's plate
}

TEST(Picture, LabelsKeepClearOfEachOther) {
  const Cloud cloud = square(1, {200, 200, 200});
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
  place.translation().z() = 1;
  const Eigen::Vector3d size = Eigen::Vector3d::Constant(0.1);
  Picture one(cloud, {800, 600}), two(cloud, {800, 600});
  one.drawLabel(place, size, "object", magenta);
  for (int i = 0; i < 2; ++i) two.drawLabel(place, size, "object", magenta);
  EXPECT_EQ(count(saved(two), magenta), 2 * count(saved(one), magenta));
}

TEST(Picture, WhatLiesBehindTheCameraIsLeftOut) {
  const Cloud cloud = square(1, {200, 200, 200});
  const Picture empty(cloud, {200, 150});
  Picture picture(cloud, {200, 150});
  Eigen::Isometry3d behind = Eigen::Isometry3d::Identity();
  behind.translation().z() = -2;
  picture.drawBox(behind, Eigen::Vector3d::Ones(), magenta);
  picture.drawCross(behind.translation(), magenta);
  picture.drawLabel(behind, Eigen::Vector3d::Ones(), "behind", magenta);
  EXPECT_EQ(encodePng(saved(picture)), encodePng(saved(empty)));
  // A long box around the camera is cut at it.
  picture.drawBox(Eigen::Isometry3d::Identity(), {0.2, 0.2, 1.9}, magenta);
  EXPECT_GT(count(saved(picture), magenta), 0u);
}

TEST(Picture, TextIsReadable) {
  ColorImage image(80, 40);
  drawText(image, "I_", {10, 30}, magenta);
  const PictureSize size = textSize("I_");
  EXPECT_GT(size.width, size.height);
  const auto inked = [&](int column, int row) { return image(row, column).r > 100; };
  EXPECT_TRUE(inked(10 + 4, 30 - size.height / 2)) << "the stem of the I";
  EXPECT_FALSE(inked(10 + 1, 30 - size.height / 2));
  EXPECT_FALSE(inked(10 + 17, 30 - size.height / 2));
  EXPECT_TRUE(inked(10 + 17, 32)) << "the line below";
  ColorImage question(20, 40), unknown(20, 40);
  drawText(question, "?", {4, 30}, magenta);
  drawText(unknown, "\x80", {4, 30}, magenta);
  EXPECT_GT(count(question, magenta), 5u);
  EXPECT_EQ(encodePng(question), encodePng(unknown));
}

TEST(Picture, PathsAreCheckedBeforehand) {
  EXPECT_EQ(test::errorOf(ErrorCode::bad_usage, [] { checkPicturePath("scene.gif"); }),
            "cannot tell the kind of picture from 'scene.gif'; let it end in .png or .jpg");
  EXPECT_EQ(test::errorOf(ErrorCode::bad_file, [] { checkPicturePath("/none/scene.PNG"); }),
            "cannot write '/none/scene.PNG': the folder /none does not exist; create it first");
}

}  // namespace sks
