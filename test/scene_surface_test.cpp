// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/stages/surface.hpp>

#include <cmath>
#include <map>
#include <tuple>

#include <gtest/gtest.h>

#include "core/surface/angular_spacing.hpp"
#include "core/surface/sanitize.hpp"
#include "synthetic.hpp"

namespace sks::test {
namespace {

constexpr float pixel = 0.002f;  // of the camera: spacing at 1 m [m]

/// Coloured, as an image.
Cloud image() {
  Cloud cloud = view({{asymmetricShape(), poseOf(35, {1, 2, 0.5f}, {0, 0, 0.8f})}}, pixel, 200, 160);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud.colors.push_back({std::uint8_t(i % 251), std::uint8_t(i % 83), 7});
  return cloud;
}

Cloud asList(Cloud cloud) {
  cloud.width = std::uint32_t(cloud.size());
  cloud.height = 1;
  return cloud;
}

Surface scene(const Cloud& cloud, double spacing, int threads = 1) {
  SurfaceSettings settings;
  settings.spacing_at_1m = spacing;
  return prepareScene(sanitize(cloud, SanitizeSettings()), settings, threads);
}

using Place = std::tuple<float, float, float>;

/// All points of a surface, by place.
std::map<Place, std::size_t> placesOf(const Surface& surface) {
  std::map<Place, std::size_t> places;
  for (std::size_t i = 0; i < surface.size(); ++i) places[{surface.x[i], surface.y[i], surface.z[i]}] = i;
  return places;
}

/// Points, colours and normals are those of the whole scene.
void expectPartOf(const Surface& all, const Surface& part) {
  const auto places = placesOf(all);
  std::size_t known = 0;
  ASSERT_EQ(part.color.size(), part.size());
  for (std::size_t i = 0; i < part.size(); ++i) {
    const auto found = places.find({part.x[i], part.y[i], part.z[i]});
    ASSERT_NE(found, places.end()) << i;
    EXPECT_EQ(part.color[i], all.color[found->second]);
    ASSERT_EQ(part.normal(i).allFinite(), all.normal(found->second).allFinite()) << i;
    if (!part.normal(i).allFinite()) continue;
    ++known;
    EXPECT_GT(part.normal(i).dot(all.normal(found->second)), 0.9999f);
  }
  EXPECT_GT(known, part.size() / 2);
}

TEST(SceneSurface, OfAnImageHasEveryNthRowAndColumnAndTheNormalsOfAll) {
  const Surface all = scene(image(), 0), half = scene(image(), 2 * pixel), third = scene(image(), 3 * pixel);
  EXPECT_NEAR(double(all.size()) / double(half.size()), 4, 0.2);
  EXPECT_NEAR(double(all.size()) / double(third.size()), 9, 0.5);
  expectPartOf(all, half);
  expectPartOf(all, third);
  EXPECT_EQ(half.sensor_origin, all.sensor_origin);
}

TEST(SceneSurface, OfAListOfPointsKeepsAll) {
  EXPECT_EQ(scene(asList(image()), 2 * pixel).x, scene(asList(image()), 0).x);
}

TEST(SceneSurface, OfAnImageThatWasEnlargedKeepsAll) {
  const Cloud small = image();
  constexpr std::uint32_t times = 8;
  Cloud large;
  large.width = times * small.width, large.height = times * small.height;
  for (std::uint32_t row = 0; row < large.height; ++row) {
    for (std::uint32_t column = 0; column < large.width; ++column) {
      const std::size_t from = std::size_t(row / times) * small.width + column / times;
      large.points.push_back(small.points[from]);
      large.colors.push_back(small.colors[from]);
    }
  }
  EXPECT_EQ(scene(large, 2 * pixel).size(), scene(small, 0).size());
}

TEST(SceneSurface, KeepsWhatTheSensorMeasuredNoMoreDensely) {
  const Surface all = scene(image(), 0);
  EXPECT_EQ(scene(image(), 1.2 * pixel).size(), all.size());
  EXPECT_EQ(scene(image(), 0.1 * pixel).size(), all.size());
}

TEST(SceneSurface, OfWhatIsFarAwayIsAsDenseThere) {
  const Cloud near = image();
  Cloud far = near;
  for (Eigen::Vector3f& p : far.points) p *= 4;  // three metres away
  EXPECT_GT(scene(far, 8 * pixel).size(), 6 * scene(near, 8 * pixel).size());
}

TEST(SceneSurface, KnowsTheSpacingOfTheSensor) {
  const float of_all = sensorSpacing(scene(image(), 0), 0.01f);
  EXPECT_NEAR(of_all, pixel, 0.3f * pixel);
  EXPECT_NEAR(sensorSpacing(scene(image(), 2 * pixel), 0.01f), of_all, 0.2f * of_all);
}

TEST(SceneSurface, IsTheSameForAnyThreads) {
  const Surface one = scene(image(), 2 * pixel, 1), many = scene(image(), 2 * pixel, 7);
  ASSERT_EQ(one.size(), many.size());
  EXPECT_EQ(one.x, many.x);
  EXPECT_EQ(one.color, many.color);
  for (std::size_t i = 0; i < one.size(); ++i) {
    if (one.normal(i).allFinite()) {
      EXPECT_EQ(one.normal(i), many.normal(i));
    }
  }
}

TEST(SceneSurface, OfAThinnedCloudIsThatOfTheResolution) {
  SurfaceSettings settings;
  settings.resolution = 0.006;
  const Cloud cloud = sanitize(image(), SanitizeSettings());
  EXPECT_EQ(prepareScene(cloud, settings, 1).x, prepareSurface(cloud, settings, Orientation::sensor, 1).x);
}

}  // namespace
}  // namespace sks::test
