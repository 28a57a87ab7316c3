// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "baselines/grouping.hpp"

namespace sks::baselines {

/// What PCL's Hough space is set to.
struct HoughParameters {
  double bin_size;   ///< [m]; also how far RANSAC's inliers may lie apart
  double threshold;  ///< votes of a maximum; negative: the fraction of the highest bin's votes
  bool interpolate;
  bool weigh;
};

/// The correspondences of each maximum that RANSAC left.
std::vector<pcl::Correspondences> houghClusters(const FramedModel& model, const FramedKeypoints& scene,
                                                const HoughParameters& parameters);

}  // namespace sks::baselines
