// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include <pcl/features/shot_omp.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <flann/flann.hpp>

#include <sks_detector/codebook.hpp>

namespace sks::bench {

/// The published method (config/paper.yaml), composed of the parts that PCL and FLANN offer. Neither has sparse
/// keypoint selection or continuous voting: their loops are written down plainly here, the latter as a Hough space of
/// bins.
class PclPipeline {
public:
  using Points = pcl::PointCloud<pcl::PointXYZ>;

  /// Builds the index of codewords: 4 kd-trees, 128 checks. @param codebook stays alive
  PclPipeline(const Codebook& codebook, const Settings& settings, int threads);

  struct Found {
    std::uint32_t object;
    Eigen::Matrix4f T_scene_model;
    std::size_t inliers;
  };
  std::vector<Found> detect(const Points::Ptr& cloud) const;

private:
  struct Vote {
    Eigen::Vector3f place, scene, model;
  };
  using Normals = pcl::PointCloud<pcl::Normal>;
  using Shots = pcl::PointCloud<pcl::SHOT352>;

  Points::Ptr selectKeypoints(const Points::Ptr& cloud, const Normals& normals) const;
  Shots describe(const Points::Ptr& cloud, const Normals::Ptr& normals, const Points::Ptr& keypoints) const;
  std::vector<int> nearestWords(const Shots& shots) const;
  std::vector<Found> findPoses(std::uint32_t object, const std::vector<Vote>& votes) const;

  const Codebook& codebook_;
  DescriptorMatrix words_;
  Settings settings_;
  int threads_;
  std::unique_ptr<flann::Index<flann::ChiSquareDistance<float>>> index_;
};

}  // namespace sks::bench
