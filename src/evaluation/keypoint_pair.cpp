// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/stages/matching.hpp>

#include "core/voting/ransac.hpp"
#include "evaluation/keypoint_study.hpp"

namespace sks {

KeypointPair comparePair(const DescribedKeypoints& object, const DescribedKeypoints& scene,
                         const RansacSettings& settings, int threads) {
  KeypointPair pair;
  pair.object_keypoints = object.keypoints.size();
  pair.scene_keypoints = scene.keypoints.size();
  const std::vector<Match> to_scene = Matcher(scene.descriptors.values).match(object.descriptors.values, threads);
  const std::vector<Match> to_object = Matcher(object.descriptors.values).match(scene.descriptors.values, threads);
  std::vector<Eigen::Vector3d> from, to;
  for (const Match& match : to_scene) {
    if (to_object[match.word].word != match.descriptor) continue;
    const auto position = [](const DescribedKeypoints& described, std::uint32_t row) {
      return described.keypoints.positions[described.descriptors.keypoints[row]].cast<double>().eval();
    };
    from.push_back(position(object, match.descriptor));
    to.push_back(position(scene, match.word));
  }
  pair.correspondences = from.size();
  const RigidConsensus consensus = rigidRansac(from, to, settings);
  pair.inliers = consensus.inliers.size();
  if (pair.inliers > 0) pair.T_scene_object = consensus.T_to_from;
  return pair;
}

}  // namespace sks
