// SPDX-License-Identifier: BSD-3-Clause
#include "core/surface/sanitize.hpp"

#include <limits>

#include <gmock/gmock.h>

#include "error_of.hpp"
#include "synthetic.hpp"

using testing::HasSubstr;

namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

std::string refusal(const sks::Cloud& cloud, const sks::SanitizeSettings& settings = {}) {
  return sks::test::errorOf(sks::ErrorCode::bad_data, [&] { sks::sanitize(cloud, settings); });
}

/// Ten places at 1.0 to 1.9 m; colours number the points.
sks::Cloud line() {
  sks::Cloud cloud;
  for (int i = 0; i < 10; ++i) {
    cloud.points.emplace_back(0.0f, 0.0f, 1.0f + 0.1f * float(i));
    cloud.colors.push_back({std::uint8_t(i), 0, 0});
  }
  cloud.width = 10;
  return cloud;
}

void append(sks::Cloud& cloud, const Eigen::Vector3f& point) {
  cloud.points.push_back(point);
  cloud.colors.push_back({std::uint8_t(cloud.colors.size()), 0, 0});
  cloud.width = std::uint32_t(cloud.size());
}

std::vector<int> numbersOf(const sks::Cloud& cloud) {
  std::vector<int> numbers;
  for (const sks::Rgb& color : cloud.colors) numbers.push_back(color.r);
  return numbers;
}

}  // namespace

TEST(Sanitize, CountsWhatItTakesAwayAndKeepsTheOrder) {
  sks::Cloud cloud = line();
  append(cloud, {not_a_number, 0, 1});  // 10
  append(cloud, {0, infinity, 1});      // 11
  append(cloud, {0, 0, -infinity});     // 12
  append(cloud, {0, 0, 25});            // 13: beyond 20 m
  append(cloud, {0.5f, 0, 1});          // 14: new
  append(cloud, {0, 0, 1.0f});          // 15: the place of 0
  append(cloud, {0.5f, 0, 1});          // 16: the place of 14
  append(cloud, {0, 0.1f, 0.2f});       // 17: nearer than 0.3 m
  sks::SanitizeSettings settings;
  settings.min_range = 0.3;
  sks::SanitizeReport report;
  const sks::Cloud kept = sks::sanitize(cloud, settings, &report);
  EXPECT_EQ(report.input, 18u);
  EXPECT_EQ(report.invalid, 3u);
  EXPECT_EQ(report.out_of_range, 2u);
  EXPECT_EQ(report.duplicates, 2u);
  EXPECT_EQ(report.kept, 11u);
  EXPECT_EQ(numbersOf(kept), (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 14}));
  EXPECT_EQ(kept.points.back(), Eigen::Vector3f(0.5f, 0, 1));
  EXPECT_EQ(kept.width, 11u);
  EXPECT_EQ(kept.height, 1u);

  settings.remove_duplicates = false;
  EXPECT_EQ(sks::sanitize(cloud, settings, &report).size(), 13u);
  EXPECT_EQ(report.duplicates, 0u);
}

TEST(Sanitize, DoesNotDependOnThreads) {
  sks::Cloud cloud = sks::test::randomCloud(2000, 1, 3);
  cloud.colors.clear();
  for (std::size_t i = 0; i < 500; ++i) cloud.points.push_back(cloud.points[7 * i % 300]);  // some of them twice
  cloud.width = 2500;
  for (std::size_t i = 0; i < 2000; i += 11) cloud.points[i].setConstant(not_a_number);
  sks::SanitizeReport report, other;
  const sks::Cloud kept = sks::sanitize(cloud, {}, &report, 1);
  EXPECT_GT(report.duplicates, 100u);
  for (const int threads : {2, 3, 8}) {
    EXPECT_EQ(sks::sanitize(cloud, {}, &other, threads).points, kept.points);
    EXPECT_EQ(other.duplicates, report.duplicates);
    EXPECT_EQ(other.invalid, report.invalid);
  }
}

TEST(Sanitize, OrganisedCloudWithHolesBecomesAList) {
  sks::Cloud cloud = line();
  cloud.colors.clear();
  cloud.points[3].setConstant(not_a_number);
  cloud.width = 5;
  cloud.height = 2;
  sks::SanitizeSettings settings;
  settings.min_points = 9;
  const sks::Cloud kept = sks::sanitize(cloud, settings);
  EXPECT_FALSE(kept.organized());
  EXPECT_FALSE(kept.hasColor());
  ASSERT_EQ(kept.size(), 9u);
  EXPECT_EQ(kept.points[2], cloud.points[2]);
  EXPECT_EQ(kept.points[3], cloud.points[4]);
}

TEST(Sanitize, NegativeZeroIsThePlaceOfZero) {
  sks::Cloud cloud = line();
  append(cloud, {-0.0f, 0.0f, 1.0f});
  append(cloud, {0.0f, -0.0f, 1.1f});
  sks::SanitizeReport report;
  sks::sanitize(cloud, {}, &report);
  EXPECT_EQ(report.duplicates, 2u);
}

TEST(Sanitize, RangeIsMeasuredFromTheSensor) {
  sks::Cloud cloud = line();
  cloud.sensor_origin = {0, 0, 100};
  sks::SanitizeSettings settings;
  settings.min_range = 98.45;
  settings.max_range = 200;
  settings.min_points = 1;
  EXPECT_EQ(numbersOf(sks::sanitize(cloud, settings)), (std::vector<int>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(sks::sanitize(cloud, settings).sensor_origin, cloud.sensor_origin);
}

TEST(Sanitize, CropBoxKeepsWhatIsInsideAndOnItsFaces) {
  sks::Cloud cloud = line();
  sks::SanitizeSettings settings;
  settings.crop = true;
  settings.crop_min_z = 1.0;
  settings.crop_max_z = 1.35;
  settings.min_points = 2;
  EXPECT_EQ(numbersOf(sks::sanitize(cloud, settings)), (std::vector<int>{0, 1, 2, 3}));
  settings.crop_min_x = 0.1;
  const std::string message = refusal(cloud, settings);
  EXPECT_THAT(message, HasSubstr("10 out of range"));
  EXPECT_THAT(message, HasSubstr("crop box"));
}

TEST(Sanitize, UnusableCloudsAreRefusedWithFigures) {
  EXPECT_EQ(refusal({}), "the cloud is empty (0 points)");

  const sks::Cloud invalid =
      sks::test::makeCloud(std::vector<Eigen::Vector3f>(12, Eigen::Vector3f(not_a_number, not_a_number, not_a_number)));
  EXPECT_THAT(refusal(invalid), HasSubstr("the cloud has 0 usable points, at least 10 are needed: of 12 points 12 are "
                                          "NaN or infinite, 0 out of range"));

  const sks::Cloud single = sks::test::makeCloud({Eigen::Vector3f(0, 0, 1)});
  EXPECT_THAT(refusal(single), HasSubstr("the cloud has 1 usable points, at least 10 are needed"));

  const sks::Cloud same = sks::test::makeCloud(std::vector<Eigen::Vector3f>(12, Eigen::Vector3f(0, 0, 1)));
  EXPECT_THAT(refusal(same), HasSubstr("11 duplicates"));
}

TEST(Sanitize, MillimetresAreNamedWithFigureAndRemedy) {
  sks::Cloud cloud = line();
  for (auto& p : cloud.points) p *= 1000;
  const std::string message = refusal(cloud);
  EXPECT_THAT(message, HasSubstr("looks like millimetres"));
  EXPECT_THAT(message, HasSubstr("1500 m"));  // the median
  EXPECT_THAT(message, HasSubstr("0.001"));
  EXPECT_THAT(message, HasSubstr("units: mm"));
}

TEST(Sanitize, WithoutAWidthACloudIsNotOrganized) {
  sks::Cloud cloud;
  cloud.points = line().points;
  for (const std::uint32_t height : {1u, 2u}) {
    cloud.height = height;
    EXPECT_FALSE(cloud.organized());
    const sks::Cloud kept = sks::sanitize(cloud, {});
    EXPECT_EQ(kept.size(), 10u);
    EXPECT_TRUE(kept.pixels.empty());
  }
}

TEST(Sanitize, AModelsOriginIsNoSensor) {
  sks::SanitizeSettings settings;
  settings.min_range = 1.5;
  EXPECT_EQ(sks::sanitizingFor(sks::Orientation::sensor, settings).min_range, 1.5);
  EXPECT_EQ(sks::sanitizingFor(sks::Orientation::outward, settings).min_range, 0);
  EXPECT_EQ(sks::sanitize(line(), sks::sanitizingFor(sks::Orientation::outward, settings)).size(), 10u);
}

TEST(Sanitize, LengthsThatDoNotFitAreRefused) {
  sks::Cloud cloud = line();
  cloud.colors.resize(7);
  EXPECT_EQ(refusal(cloud), "the cloud holds 7 colours for 10 points");
  cloud = line();
  cloud.height = 2;
  EXPECT_EQ(refusal(cloud), "the cloud holds 10 points, but its width x height is 10 x 2");
  cloud = line();
  cloud.sensor_origin.x() = not_a_number;
  EXPECT_EQ(refusal(cloud), "the cloud's sensor origin (viewpoint) does not lie within 1000 km of its points' origin");
  cloud.sensor_origin.x() = 1e30f;
  EXPECT_EQ(refusal(cloud), "the cloud's sensor origin (viewpoint) does not lie within 1000 km of its points' origin");
}
