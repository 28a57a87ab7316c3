// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/hypothesis.hpp>

#include <algorithm>
#include <map>

#include "core/ransac.hpp"

namespace sks {
namespace {

struct ViewConsensus {
  std::uint32_t view = 0;
  std::vector<std::uint32_t> votes;  // inliers, indices into the class's votes
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
};

Eigen::Vector3f position(const Codebook& codebook, const Vote& vote) {
  return codebook.words[vote.word].position;
}

/// RANSAC over the votes of one training view.
ViewConsensus consensusOfView(const Codebook& codebook, std::uint32_t view, const std::vector<Vote>& votes,
                              const std::vector<std::uint32_t>& members, const RansacSettings& settings) {
  std::vector<Eigen::Vector3d> model, scene;
  for (const std::uint32_t i : members) {
    model.push_back(position(codebook, votes[i]).cast<double>());
    scene.push_back(votes[i].keypoint.cast<double>());
  }
  ViewConsensus consensus;
  consensus.view = view;
  const RigidConsensus found = rigidRansac(model, scene, settings);
  consensus.T_scene_model = found.T_to_from;
  for (const std::size_t i : found.inliers) consensus.votes.push_back(members[i]);
  return consensus;
}

/// Mean of the extents that the votes' views bring along.
Eigen::Vector3d meanExtent(const Codebook& codebook, const std::vector<Vote>& votes,
                           const std::vector<std::uint32_t>& members) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::uint32_t i : members) {
    sum += codebook.views[codebook.words[votes[i].word].view].extent().cast<double>();
  }
  return sum / double(members.size());
}

}  // namespace

bool estimateHypothesis(const Codebook& codebook, std::uint32_t object, const std::vector<Vote>& votes,
                        const Maximum& maximum, const Settings& settings, Hypothesis& hypothesis) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> by_view;
  for (const std::uint32_t i : maximum.votes) by_view[codebook.words[votes[i].word].view].push_back(i);

  ViewConsensus best;
  std::vector<std::uint32_t> inliers;
  for (const auto& [view, members] : by_view) {
    if (members.size() < 3) {  // too few pairs to speak for or against a pose
      inliers.insert(inliers.end(), members.begin(), members.end());
      continue;
    }
    const ViewConsensus consensus = consensusOfView(codebook, view, votes, members, settings.ransac);
    if (consensus.votes.size() < std::size_t(settings.ransac.min_inliers)) continue;
    inliers.insert(inliers.end(), consensus.votes.begin(), consensus.votes.end());
    if (consensus.votes.size() > best.votes.size()) best = consensus;
  }
  if (best.votes.empty()) return false;
  std::sort(inliers.begin(), inliers.end());

  const TrainingView& view = codebook.views[best.view];
  hypothesis.object = object;
  hypothesis.view = best.view;
  hypothesis.T_scene_model = best.T_scene_model;
  hypothesis.T_scene_box = best.T_scene_model * Eigen::Translation3d(view.center().cast<double>());
  hypothesis.box_size = meanExtent(codebook, votes, best.votes);
  hypothesis.votes = std::uint32_t(maximum.votes.size());
  hypothesis.inliers = inliers;
  std::vector<Eigen::Vector3f> positions;
  for (const std::uint32_t i : inliers) positions.push_back(votes[i].position);
  hypothesis.density = kernelDensity(maximum.position, positions, settings.voting.bandwidth);
  return true;
}

}  // namespace sks
