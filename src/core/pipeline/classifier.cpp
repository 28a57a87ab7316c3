// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/classifier.hpp"

#include <algorithm>
#include <cmath>

#include "core/matching/object_matching.hpp"
#include "core/pipeline/default_stages.hpp"
#include "core/pipeline/isolated_object.hpp"
#include "core/voting/maxima.hpp"
#include "core/voting/vote_density.hpp"

namespace sks {
namespace {

/// What the density of one vote counts, for each object.
std::vector<double> voteStrengths(const Codebook& codebook, ClassBalance balance) {
  std::vector<double> words(codebook.objects.size(), 0);
  for (const Codeword& word : codebook.words) words[codebook.views[word.view].object] += 1;
  std::vector<double> strength(words.size(), 1);
  if (balance == ClassBalance::none) return strength;
  for (std::size_t i = 0; i < words.size(); ++i) strength[i] = 1 / std::sqrt(std::max(1.0, words[i]));
  return strength;
}

}  // namespace

Classifier::Classifier(std::shared_ptr<const Codebook> codebook, const Settings& settings, ClassBalance balance)
    : strength_(voteStrengths(*codebook, balance)) {
  const Settings used = settingsFor(*codebook, settings);
  const double ambiguity = used.matching.ambiguity;
  const MatchFunction match = [matcher = ObjectMatcher(*codebook), ambiguity](const DescriptorMatrix& d, int threads) {
    return matcher.match(d, ambiguity, threads);
  };
  describer_ = {codebook, used, completed({}, *codebook), match};
}

Classification Classifier::classify(const Cloud& cloud, ViewKind kind) const {
  const auto strengths = [this](const SceneDescription& scene) {
    const Settings& settings = describer_.settings;
    const auto maxima = findAllMaxima(scene.votes, settings, threadCount(settings));
    ObjectStrengths found{std::vector<double>(strength_.size(), 0), maxima.size()};
    for (std::size_t object = 0; object < found.of_object.size(); ++object) {
      const VoteDensity density(scene.votes[object], settings.voting.bandwidth);
      double& strongest = found.of_object[object];
      for (const ObjectMaximum& candidate : maxima) {
        if (candidate.object != object) continue;
        strongest = std::max(strongest, strength_[object] * density.at(candidate.maximum.position));
      }
    }
    return found;
  };
  return classifyIsolated(cloud, kind, describer_, strengths);
}

ViewKind testKind(const Codebook& codebook) {
  const auto is_model = [](const TrainingView& view) { return view.kind == ViewKind::model; };
  return std::all_of(codebook.views.begin(), codebook.views.end(), is_model) ? ViewKind::model : ViewKind::view;
}

}  // namespace sks
