// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/stages/voting.hpp>

namespace sks {

std::vector<std::vector<Vote>> castVotes(const Codebook& codebook, const std::vector<Match>& matches,
                                         const Descriptors& descriptors, const Keypoints& keypoints) {
  std::vector<std::vector<Vote>> spaces(codebook.objects.size());
  for (const Match& match : matches) {
    const Codeword& word = codebook.words[match.word];
    const TrainingView& view = codebook.views[word.view];
    Vote vote;
    vote.keypoint = keypoints.positions[descriptors.keypoints[match.descriptor]];
    vote.rotation = descriptors.frames[match.descriptor].transpose() * word.frame;  // R_s^T R_t
    vote.position = vote.keypoint + vote.rotation * (view.center() - word.position);
    vote.word = match.word;
    vote.distance = match.distance;
    vote.weight = match.weight;
    spaces[view.object].push_back(vote);
  }
  return spaces;
}

}  // namespace sks
