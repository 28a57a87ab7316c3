// SPDX-License-Identifier: BSD-3-Clause
// Its template, as the library of PCL that holds it loads VTK.
#include <pcl/recognition/impl/cg/geometric_consistency.hpp>

#include "baselines/grouping.hpp"

namespace sks::baselines {

Grouping consistencyGrouping(const ChenSettings& settings) {
  return [=](const FramedModel& model, const FramedKeypoints& scene) {
    pcl::GeometricConsistencyGrouping<pcl::PointXYZ, pcl::PointXYZ> grouping;
    grouping.setGCSize(settings.resolution);
    grouping.setGCThreshold(settings.consensus - 1);  // PCL wants more than this
    grouping.setInputCloud(model.keypoints.positions);
    grouping.setSceneCloud(scene.positions);
    grouping.setModelSceneCorrespondences(model.correspondences);
    std::vector<Eigen::Matrix4f, Eigen::aligned_allocator<Eigen::Matrix4f>> transforms;
    std::vector<pcl::Correspondences> clusters;
    grouping.recognize(transforms, clusters);
    return groupsOf(clusters, model, scene, settings.resolution);
  };
}

}  // namespace sks::baselines
