// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/stages/descriptors.hpp>

#include <cmath>

#include <gmock/gmock.h>

#include "bumps.hpp"
#include "error_of.hpp"
#include "synthetic.hpp"

using sks::DescriptorType;
using testing::HasSubstr;

namespace {

sks::Surface prepare(const sks::Cloud& cloud, sks::Orientation orientation = sks::Orientation::sensor) {
  return sks::prepareSurface(cloud, {}, orientation, 2);
}

/// A camera's view of an object without symmetries, unorganised.
sks::Cloud objectView(bool color = false) {
  const sks::test::Placed object{sks::test::asymmetricShape(), sks::test::poseOf(35, {1, 2, 0.5f}, {0, 0, 0.8f})};
  const sks::Cloud seen = sks::test::view({object}, 0.0025f, 160, 120, color);
  sks::Cloud cloud;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!seen.points[i].allFinite()) continue;
    cloud.points.push_back(seen.points[i]);
    if (color) cloud.colors.push_back(seen.colors[i]);
  }
  cloud.width = std::uint32_t(cloud.size());
  return cloud;
}

double cosine(const float* a, const float* b, std::size_t size) {
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < size; ++i) {
    ab += double(a[i]) * b[i];
    aa += double(a[i]) * a[i];
    bb += double(b[i]) * b[i];
  }
  return ab / std::sqrt(aa * bb);
}

}  // namespace

TEST(Cshot, BeginsWithShot) {
  const sks::Surface surface = prepare(objectView(true));
  const sks::Keypoints keypoints = sks::gridKeypoints(surface, 0.02);
  const auto color = sks::computeDescriptors(surface, keypoints, DescriptorType::cshot, {}, 1);
  const auto shape = sks::computeDescriptors(surface, keypoints, DescriptorType::shot, {}, 1);
  ASSERT_EQ(color.keypoints, shape.keypoints);
  for (std::size_t row = 0; row < shape.values.rows(); ++row) {
    EXPECT_GT(cosine(color.values.row(row), shape.values.row(row), sks::shot_size), 0.999999);
  }
}

TEST(Cshot, NeedsColor) {
  const sks::Surface surface = prepare(sks::test::bumps());
  const sks::Keypoints keypoints = sks::gridKeypoints(surface, 0.02);
  const std::string message = sks::test::errorOf(
      sks::ErrorCode::incompatible, [&] { sks::computeDescriptors(surface, keypoints, DescriptorType::cshot, {}, 1); });
  EXPECT_THAT(message, HasSubstr("CSHOT describes colour, but the cloud has none"));
  EXPECT_THAT(message, HasSubstr("descriptor.type=shot"));
}

class Descriptor : public testing::TestWithParam<DescriptorType> {};

TEST_P(Descriptor, IsTheSameInEveryFrame) {
  const sks::Cloud cloud = objectView(true);
  const Eigen::Isometry3f T = sks::test::poseOf(110, {0.3f, -1, 0.6f}, {0.4f, 0.1f, -0.7f});
  const sks::Surface here = prepare(cloud), there = prepare(sks::test::transformed(cloud, T));
  const sks::Keypoints keypoints = sks::gridKeypoints(here, 0.01);
  sks::Keypoints moved;
  for (const auto& p : keypoints.positions) moved.positions.push_back(T * p);
  const auto a = sks::computeDescriptors(here, keypoints, GetParam(), {}, 2);
  const auto b = sks::computeDescriptors(there, moved, GetParam(), {}, 2);
  ASSERT_EQ(a.keypoints, b.keypoints);
  std::size_t same = 0, turned = 0;
  for (std::size_t row = 0; row < a.values.rows(); ++row) {
    same += cosine(a.values.row(row), b.values.row(row), a.values.cols()) >= 0.999;
    // Axes as rows: R_there = R_here * R^T.
    turned += (b.frames[row] - a.frames[row] * T.linear().transpose()).cwiseAbs().maxCoeff() < 0.01f;
  }
  EXPECT_GE(double(same), 0.95 * double(a.values.rows()));
  EXPECT_GE(double(turned), 0.95 * double(a.values.rows()));
}

TEST_P(Descriptor, HasUnitNormAndARightHandedFrame) {
  const sks::Surface surface = prepare(objectView(true));
  const auto descriptors = sks::computeDescriptors(surface, sks::gridKeypoints(surface, 0.02), GetParam(), {}, 1);
  ASSERT_GT(descriptors.values.rows(), 20u);
  EXPECT_EQ(descriptors.values.cols(), sks::descriptorSize(GetParam()));
  EXPECT_EQ(descriptors.frames.size(), descriptors.values.rows());
  for (std::size_t row = 0; row < descriptors.values.rows(); ++row) {
    double squares = 0;
    for (std::size_t i = 0; i < descriptors.values.cols(); ++i) {
      EXPECT_GE(descriptors.values.row(row)[i], 0);
      squares += std::pow(double(descriptors.values.row(row)[i]), 2);
    }
    EXPECT_NEAR(squares, 1, 1e-5);
    const Eigen::Matrix3f& frame = descriptors.frames[row];
    EXPECT_LT((frame * frame.transpose() - Eigen::Matrix3f::Identity()).cwiseAbs().maxCoeff(), 1e-5f);
    EXPECT_NEAR(frame.determinant(), 1, 1e-5);
  }
}

// Traps 9 and 10: threads share the work unevenly, but never the result.
TEST_P(Descriptor, IsTheSameToTheLastBitForAnyThreads) {
  const sks::Surface surface = prepare(objectView(true));
  const sks::Keypoints keypoints = sks::gridKeypoints(surface, 0.01);
  const auto one = sks::computeDescriptors(surface, keypoints, GetParam(), {}, 1);
  for (const int threads : {2, 5}) {
    const auto more = sks::computeDescriptors(surface, keypoints, GetParam(), {}, threads);
    ASSERT_EQ(more.keypoints, one.keypoints);
    const std::size_t values = one.values.rows() * one.values.cols();
    EXPECT_TRUE(std::equal(one.values.data(), one.values.data() + values, more.values.data()));
    EXPECT_TRUE(std::equal(one.frames.begin(), one.frames.end(), more.frames.begin()));
  }
}

INSTANTIATE_TEST_SUITE_P(Types, Descriptor, testing::Values(DescriptorType::shot, DescriptorType::cshot));

TEST(Descriptors, NeedEnoughNeighbors) {
  sks::Cloud cloud = sks::test::bumps();
  const Eigen::Vector3f lone(0.5f, 0.5f, 1);
  for (int i = 0; i < 4; ++i) cloud.points.push_back(lone + 0.002f * float(i) * Eigen::Vector3f(1, float(i), 0));
  const sks::Surface surface = prepare(cloud);
  sks::Keypoints keypoints;
  keypoints.positions = {lone, {0, 0, 1.015f}, {5, 5, 5}};
  const auto descriptors = sks::computeDescriptors(surface, keypoints, DescriptorType::shot, {}, 1);
  EXPECT_EQ(descriptors.keypoints, (std::vector<std::uint32_t>{1}));
  EXPECT_EQ(descriptors.values.rows(), 1u);
  sks::DescriptorSettings settings;
  settings.min_neighbors = 10000;
  EXPECT_EQ(sks::computeDescriptors(surface, keypoints, DescriptorType::shot, settings, 1).values.rows(), 0u);
  EXPECT_EQ(sks::computeDescriptors(surface, {}, DescriptorType::shot, {}, 1).values.rows(), 0u);
}

TEST(Descriptors, OfIdenticalPointsAreNone) {
  sks::Surface surface = prepare(sks::test::makeCloud(std::vector<Eigen::Vector3f>(20, Eigen::Vector3f(0, 0, 1))));
  sks::Keypoints keypoints;
  keypoints.positions = {{0, 0, 1}};
  EXPECT_EQ(sks::computeDescriptors(surface, keypoints, DescriptorType::shot, {}, 1).values.rows(), 0u);
}

TEST(Descriptors, OfFullModelsDescribeWhatACameraSees) {
  // A lens of 16 mm: the far side lies within the radius, but faces away.
  using sks::test::Solid;
  const sks::test::Shape lens{{Solid::Shape::ellipsoid, {0, 0, 1}, {0.08f, 0.06f, 0.008f}}};
  const sks::Surface full = prepare(sks::test::model(lens, 0.003f), sks::Orientation::outward);
  sks::Cloud near_side;
  for (std::size_t i = 0; i < full.size(); ++i) {
    if (full.normal(i).z() < -0.5f) near_side.points.push_back(full.point(i));
  }
  sks::Keypoints keypoints;
  keypoints.positions = {{0.05f, 0.01f, 0.9938f}};
  const auto seen = sks::computeDescriptors(prepare(near_side), keypoints, DescriptorType::shot, {}, 1);
  const auto facing = sks::computeDescriptors(full, keypoints, DescriptorType::shot, {}, 1);
  sks::DescriptorSettings settings;
  settings.model_facing = -1;
  const auto all = sks::computeDescriptors(full, keypoints, DescriptorType::shot, settings, 1);
  ASSERT_EQ(seen.values.rows() + facing.values.rows() + all.values.rows(), 3u);
  EXPECT_GT(cosine(seen.values.row(0), facing.values.row(0), sks::shot_size), 0.9);
  EXPECT_LT(cosine(seen.values.row(0), all.values.row(0), sks::shot_size), 0.8);
}

TEST(DescriptorMatrix, NeedsWholeRows) {
  const sks::DescriptorMatrix matrix({1, 2, 3, 4, 5, 6}, 3);
  EXPECT_EQ(matrix.rows(), 2u);
  EXPECT_EQ(matrix.row(1)[0], 4);
  EXPECT_EQ(sks::test::errorOf(sks::ErrorCode::bad_data,
                               [] {
                                 sks::DescriptorMatrix({1, 2, 3, 4}, 3);
                               }),
            "a descriptor matrix of 4 values has no whole rows of 3");
}
