// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/hough_grouping.hpp"

#include <pcl/recognition/cg/hough_3d.h>

namespace sks::baselines {

std::vector<pcl::Correspondences> houghClusters(const FramedModel& model, const FramedKeypoints& scene,
                                                const HoughParameters& parameters) {
  pcl::Hough3DGrouping<pcl::PointXYZ, pcl::PointXYZ, pcl::ReferenceFrame, pcl::ReferenceFrame> hough;
  hough.setHoughBinSize(parameters.bin_size);
  hough.setHoughThreshold(parameters.threshold);
  hough.setUseInterpolation(parameters.interpolate);
  hough.setUseDistanceWeight(parameters.weigh);
  hough.setInputCloud(model.keypoints.positions);
  hough.setInputRf(model.keypoints.frames);
  hough.setSceneCloud(scene.positions);
  hough.setSceneRf(scene.frames);
  hough.setModelSceneCorrespondences(model.correspondences);
  std::vector<Eigen::Matrix4f, Eigen::aligned_allocator<Eigen::Matrix4f>> transforms;
  std::vector<pcl::Correspondences> clusters;
  hough.recognize(transforms, clusters);
  return clusters;
}

Grouping houghGrouping(const TombariSettings& settings) {
  return [=](const FramedModel& model, const FramedKeypoints& scene) {
    const HoughParameters parameters{settings.bin_size, settings.votes, settings.interpolate, settings.weigh};
    return groupsOf(houghClusters(model, scene, parameters), model, scene, settings.bin_size);
  };
}

}  // namespace sks::baselines
