// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/grouping.hpp"

#include <utility>

#include <sks_detector/stages/hypothesis.hpp>

#include "core/voting/ransac.hpp"

namespace sks::baselines {
namespace {

Eigen::Isometry3d fitTo(const pcl::Correspondences& correspondences, const FramedModel& model,
                        const FramedKeypoints& scene) {
  const PointPairs pairs = pairsOf(correspondences, model, scene);
  return fitRigid(pairs.model, pairs.scene);
}

}  // namespace

PointPairs pairsOf(const pcl::Correspondences& correspondences, const FramedModel& model,
                   const FramedKeypoints& scene) {
  PointPairs pairs;
  for (const pcl::Correspondence& pair : correspondences) {
    pairs.model.push_back(model.keypoints.position(pair.index_query));
    pairs.scene.push_back(scene.position(pair.index_match));
  }
  return pairs;
}

pcl::Correspondences inliersOf(const pcl::Correspondences& correspondences, const FramedModel& model,
                               const FramedKeypoints& scene, const Eigen::Isometry3d& T_scene_model, double distance) {
  pcl::Correspondences inliers;
  for (const pcl::Correspondence& pair : correspondences) {
    const Eigen::Vector3d mapped = T_scene_model * model.keypoints.position(pair.index_query);
    if ((mapped - scene.position(pair.index_match)).norm() <= distance) inliers.push_back(pair);
  }
  return inliers;
}

std::vector<Group> groupsOf(const std::vector<pcl::Correspondences>& clusters, const FramedModel& model,
                            const FramedKeypoints& scene, double distance) {
  std::vector<Group> groups;
  for (const pcl::Correspondences& cluster : clusters) {
    if (cluster.size() < 3) continue;
    Group group;
    group.inliers = inliersOf(cluster, model, scene, fitTo(cluster, model, scene), distance);
    if (group.inliers.size() < 3) continue;
    group.T_scene_model = fitTo(group.inliers, model, scene);
    groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace sks::baselines
