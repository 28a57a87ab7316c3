// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/weighted_voting_classifier.hpp"

#include <algorithm>
#include <utility>

#include "core/hough_hypotheses.hpp"
#include "core/scene_description.hpp"
#include "core/stopwatch.hpp"
#include "core/vote_density.hpp"

namespace sks::baselines {

WeightedVotingClassifier::WeightedVotingClassifier(std::shared_ptr<const Codebook> codebook, const Settings& settings,
                                                   const SeibSettings& own)
    : codebook_(std::move(codebook)),
      settings_(settingsFor(*codebook_, settings)),
      own_(own),
      matcher_(*codebook_),
      strength_(voteStrengths(*codebook_, own.balance ? ClassBalance::codewords : ClassBalance::none)) {}

Classification WeightedVotingClassifier::classify(const Cloud& cloud, ViewKind kind) const {
  Classification result;
  Stopwatch total;
  const Orientation orientation = kind == ViewKind::model ? Orientation::outward : Orientation::sensor;
  const auto match = [this](const DescriptorMatrix& d, int n) { return matcher_.match(d, own_.distance_ratio, n); };
  const SceneDescription scene =
      describeScene(cloud, orientation, *codebook_, match, settings_, result.times, result.counts);

  Stopwatch stage;
  const auto maxima = findAllMaxima(scene.votes, settings_, threadCount(settings_));
  std::vector<double> strengths(codebook_->objects.size(), 0);
  for (std::size_t object = 0; object < strengths.size(); ++object) {
    const VoteDensity density(scene.votes[object], settings_.voting.bandwidth);
    for (const ObjectMaximum& found : maxima) {
      if (found.object != object) continue;
      strengths[object] = std::max(strengths[object], strength_[object] * density.at(found.maximum.position));
    }
  }
  result.candidates = rankedCandidates(codebook_->objects, strengths);
  result.counts.hypotheses = maxima.size();
  result.times.voting += stage.lap();
  result.times.total = total.lap();
  return result;
}

}  // namespace sks::baselines
