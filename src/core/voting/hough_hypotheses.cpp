// SPDX-License-Identifier: BSD-3-Clause
#include "core/voting/hough_hypotheses.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include "core/voting/main_view.hpp"
#include "core/voting/ransac.hpp"

namespace sks {
namespace {

struct FrameConsensus {
  std::uint32_t view = 0;            // the one of the frame with most inliers
  std::vector<std::uint32_t> votes;  // inliers, indices into the class's votes
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
};

Eigen::Vector3f position(const Codebook& codebook, const Vote& vote) {
  return codebook.words[vote.word].position;
}

std::uint32_t viewOf(const Codebook& codebook, const Vote& vote) {
  return codebook.words[vote.word].view;
}

std::vector<std::uint32_t> wordsOf(const std::vector<Vote>& votes, const std::vector<std::uint32_t>& members) {
  std::vector<std::uint32_t> words;
  for (const std::uint32_t i : members) words.push_back(votes[i].word);
  return words;
}

constexpr double largest_rotation =
    40 * EIGEN_PI / 180;  // between a vote's own rotation and the pose, in a shared frame

/// Whether the local frames of a correspondence rotate the model as the pose does.
bool rotatesAlike(const Vote& vote, const Eigen::Isometry3d& T_scene_model) {
  const Eigen::Matrix3d difference = T_scene_model.linear().transpose() * vote.rotation.cast<double>();
  return difference.trace() >= 1 + 2 * std::cos(largest_rotation);
}

/// RANSAC over the votes of the training views of one frame. A shared frame offers many pairs, of which some fit any
/// motion by chance: there, a vote's own rotation must fit as well.
FrameConsensus consensusOfFrame(const Codebook& codebook, const std::vector<Vote>& votes,
                                const std::vector<std::uint32_t>& members, const RansacSettings& settings) {
  std::vector<Eigen::Vector3d> model, scene;
  for (const std::uint32_t i : members) {
    model.emplace_back(position(codebook, votes[i]).cast<double>());
    scene.emplace_back(votes[i].keypoint.cast<double>());
  }
  FrameConsensus consensus;
  const RigidConsensus found = rigidRansac(model, scene, settings);
  consensus.T_scene_model = found.T_to_from;
  const bool shared = !codebook.views[viewOf(codebook, votes[members.front()])].frame.empty();
  for (const std::size_t i : found.inliers) {
    if (!shared || rotatesAlike(votes[members[i]], found.T_to_from)) consensus.votes.push_back(members[i]);
  }
  if (!consensus.votes.empty()) consensus.view = mainView(codebook, wordsOf(votes, consensus.votes));
  return consensus;
}

/// Mean of the extents that the votes' views bring along.
Eigen::Vector3d meanExtent(const Codebook& codebook, const std::vector<Vote>& votes,
                           const std::vector<std::uint32_t>& members) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::uint32_t i : members) {
    sum += codebook.views[viewOf(codebook, votes[i])].extent().cast<double>();
  }
  return sum / double(members.size());
}

/// Of the votes of `members` at `position`.
double densityAt(const Eigen::Vector3f& position, const std::vector<Vote>& votes,
                 const std::vector<std::uint32_t>& members, double bandwidth) {
  std::vector<Eigen::Vector3f> positions;
  positions.reserve(members.size());
  for (const std::uint32_t i : members) positions.push_back(votes[i].position);
  return kernelDensity(position, positions, bandwidth);
}

}  // namespace

bool estimateHypothesis(const Codebook& codebook, std::uint32_t object, const std::vector<Vote>& votes,
                        const Maximum& maximum, const Settings& settings, Hypothesis& hypothesis) {
  std::map<std::pair<std::string_view, std::uint32_t>, std::vector<std::uint32_t>> by_frame;
  for (const std::uint32_t i : maximum.votes) {
    const std::uint32_t view = viewOf(codebook, votes[i]);
    const std::string_view frame = codebook.views[view].frame;
    by_frame[{frame, frame.empty() ? view : 0}].push_back(i);
  }

  FrameConsensus best;
  std::vector<std::uint32_t> inliers;
  for (const auto& [frame, members] : by_frame) {
    if (members.size() < 3) {  // too few pairs to speak for or against a pose
      inliers.insert(inliers.end(), members.begin(), members.end());
      continue;
    }
    const FrameConsensus consensus = consensusOfFrame(codebook, votes, members, settings.ransac);
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
  const double bandwidth = settings.voting.bandwidth;
  hypothesis.density = densityAt(maximum.position, votes, inliers, bandwidth);
  // Votes of other frames point to the same place, but say nothing of this pose: they count by the root.
  hypothesis.evidence = std::sqrt(hypothesis.density * densityAt(maximum.position, votes, best.votes, bandwidth));
  return true;
}

std::vector<Hypothesis> houghHypotheses(const Codebook& codebook, const std::vector<std::vector<Vote>>& spaces,
                                        const std::vector<ObjectMaximum>& maxima, const Settings& settings) {
  std::vector<Hypothesis> hypotheses;
  for (const auto& [object, maximum] : maxima) {
    Hypothesis hypothesis;
    if (estimateHypothesis(codebook, object, spaces[object], maximum, settings, hypothesis)) {
      hypotheses.push_back(std::move(hypothesis));
    }
  }
  return hypotheses;
}

}  // namespace sks
