// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/stages/descriptors.hpp>

#include <cmath>

#include <gtest/gtest.h>
#include <pcl/features/shot.h>
#include <pcl/search/kdtree.h>

#include "bumps.hpp"
#include "pcl_clouds.hpp"
#include "synthetic.hpp"

using sks::DescriptorType;

namespace {

constexpr float radius = 0.05f;

sks::Surface prepare(const sks::Cloud& cloud) {
  return sks::prepareSurface(cloud, {}, sks::Orientation::sensor, 2);
}

/// A camera's view of an object without symmetries, unorganised.
sks::Cloud objectView() {
  const sks::test::Placed object{sks::test::asymmetricShape(), sks::test::poseOf(35, {1, 2, 0.5f}, {0, 0, 0.8f})};
  std::vector<Eigen::Vector3f> points;
  for (const auto& p : sks::test::view({object}).points) {
    if (p.allFinite()) points.push_back(p);
  }
  return sks::test::makeCloud(points);
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

struct Agreement {
  std::size_t compared = 0, descriptors = 0, frames = 0;

  /// @param frame row-major, axes as rows
  void add(const sks::Descriptors& ours, std::size_t row, const float* descriptor, const float* frame) {
    const Eigen::Map<const Eigen::Matrix<float, 3, 3, Eigen::RowMajor>> expected(frame);
    ++compared;
    descriptors += cosine(ours.values.row(row), descriptor, ours.values.cols()) >= 0.999;
    frames += (ours.frames[row] - expected).cwiseAbs().maxCoeff() < 1e-3f;
  }
  void expectShare(double share) const {
    ASSERT_GT(compared, 30u);
    EXPECT_GE(double(descriptors), share * double(compared));
    EXPECT_GE(double(frames), share * double(compared));
  }
};

template <typename Point, typename Descriptor, typename Estimation>
pcl::PointCloud<Descriptor> pclDescriptors(const pcl::PointCloud<Point>& keypoints,
                                           const typename pcl::PointCloud<Point>::Ptr& points,
                                           const sks::Surface& surface) {
  Estimation estimation;
  estimation.setInputCloud(keypoints.makeShared());
  estimation.setSearchSurface(points);
  estimation.setInputNormals(sks::test::pclNormals(surface));
  estimation.setSearchMethod(typename pcl::search::KdTree<Point>::Ptr(new pcl::search::KdTree<Point>));
  estimation.setRadiusSearch(radius);
  estimation.setLRFRadius(radius);
  pcl::PointCloud<Descriptor> descriptors;
  estimation.compute(descriptors);
  return descriptors;
}

}  // namespace

TEST(Shot, EqualsPcl) {
  Agreement agreement;
  for (const sks::Cloud& cloud : {objectView(), sks::test::bumps()}) {
    const sks::Surface surface = prepare(cloud);
    const sks::Keypoints keypoints = sks::gridKeypoints(surface, 0.01);
    const auto ours = sks::computeDescriptors(surface, keypoints, DescriptorType::shot, {}, 2);
    using Estimation = pcl::SHOTEstimation<pcl::PointXYZ, pcl::Normal, pcl::SHOT352>;
    const auto expected = pclDescriptors<pcl::PointXYZ, pcl::SHOT352, Estimation>(
        *sks::test::pclPoints(keypoints.positions), sks::test::pclPoints(surface.positions()), surface);
    ASSERT_EQ(ours.values.cols(), 352u);
    for (std::size_t row = 0; row < ours.keypoints.size(); ++row) {
      const pcl::SHOT352& theirs = expected[ours.keypoints[row]];
      if (std::isfinite(theirs.descriptor[0])) agreement.add(ours, row, theirs.descriptor, theirs.rf);
    }
  }
  agreement.expectShare(0.98);
}

TEST(Cshot, EqualsPcl) {
  // Stripes wider than what stands for a keypoint's own colour; only keypoints well inside one are compared.
  sks::Cloud cloud = sks::test::bumps();
  const auto colorAt = [](float x) {
    return int(std::floor(x / 0.045f)) % 2 ? sks::Rgb{200, 40, 30} : sks::Rgb{30, 120, 170};
  };
  const auto isInside = [](float x) { return std::abs(x / 0.045f - std::round(x / 0.045f)) * 0.045f > 0.0105f; };
  for (const auto& p : cloud.points) cloud.colors.push_back(colorAt(p.x()));
  const sks::Surface surface = prepare(cloud);
  pcl::PointCloud<pcl::PointXYZRGBA>::Ptr points(new pcl::PointCloud<pcl::PointXYZRGBA>);
  pcl::PointCloud<pcl::PointXYZRGBA> pcl_keypoints;
  const auto append = [&](pcl::PointCloud<pcl::PointXYZRGBA>& to, const Eigen::Vector3f& p) {
    pcl::PointXYZRGBA point;
    point.getVector3fMap() = p;
    const sks::Rgb color = colorAt(p.x());
    point.r = color.r;
    point.g = color.g;
    point.b = color.b;
    to.push_back(point);
  };
  for (const auto& p : surface.positions()) append(*points, p);
  sks::Keypoints keypoints;
  for (const auto& p : sks::gridKeypoints(surface, 0.01).positions) {
    if (!isInside(p.x())) continue;
    keypoints.positions.push_back(p);
    append(pcl_keypoints, p);
  }
  const auto ours = sks::computeDescriptors(surface, keypoints, DescriptorType::cshot, {}, 2);
  using Estimation = pcl::SHOTColorEstimation<pcl::PointXYZRGBA, pcl::Normal, pcl::SHOT1344>;
  const auto expected = pclDescriptors<pcl::PointXYZRGBA, pcl::SHOT1344, Estimation>(pcl_keypoints, points, surface);
  ASSERT_EQ(ours.values.cols(), 1344u);
  Agreement agreement;
  for (std::size_t row = 0; row < ours.keypoints.size(); ++row) {
    const pcl::SHOT1344& theirs = expected[ours.keypoints[row]];
    if (std::isfinite(theirs.descriptor[0])) agreement.add(ours, row, theirs.descriptor, theirs.rf);
  }
  agreement.expectShare(0.98);
}
