// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "baselines/hough_grouping.hpp"
#include "core/voting/ransac.hpp"

namespace sks::baselines {
namespace {

/// The consensus of correspondences; nothing where no three of them agree.
Group consensusOf(const pcl::Correspondences& correspondences, const FramedModel& model, const FramedKeypoints& scene,
                  RansacSettings settings, double distance) {
  settings.inlier_threshold = distance;
  const PointPairs pairs = pairsOf(correspondences, model, scene);
  const RigidConsensus consensus = rigidRansac(pairs.model, pairs.scene, settings);
  Group group;
  group.T_scene_model = consensus.T_to_from;
  for (const std::size_t i : consensus.inliers) group.inliers.push_back(correspondences[i]);
  return group;
}

}  // namespace

Grouping selfAdaptedGrouping(const ZhouSettings& settings, const RansacSettings& ransac, double spacing) {
  return [=](const FramedModel& model, const FramedKeypoints& scene) {
    const HoughParameters parameters{settings.bin_size, -settings.peak_share, true, false};
    const double first = settings.first_spacings * spacing, second = settings.second_spacings * spacing;
    std::vector<Group> groups;
    for (const pcl::Correspondences& cluster : houghClusters(model, scene, parameters)) {
      if (double(cluster.size()) < settings.votes) continue;
      const Group rough = consensusOf(cluster, model, scene, ransac, first);
      if (rough.inliers.empty()) continue;
      const auto near = inliersOf(*model.correspondences, model, scene, rough.T_scene_model, first);
      Group group = consensusOf(near, model, scene, ransac, second);
      if (group.inliers.size() >= std::size_t(ransac.min_inliers)) groups.push_back(std::move(group));
    }
    return groups;
  };
}

}  // namespace sks::baselines
