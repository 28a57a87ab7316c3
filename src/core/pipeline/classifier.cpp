// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/classifier.hpp"

#include <algorithm>
#include <cmath>

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
    : codebook_(std::move(codebook)),
      settings_(settingsFor(*codebook_, settings)),
      matcher_(*codebook_),
      strength_(voteStrengths(*codebook_, balance)) {}

Classification Classifier::classify(const Cloud& cloud, ViewKind kind) const {
  const double ambiguity = settings_.matching.ambiguity;
  const auto match = [&](const DescriptorMatrix& d, int threads) { return matcher_.match(d, ambiguity, threads); };
  const auto strengths = [&](const SceneDescription& scene) {
    const auto maxima = findAllMaxima(scene.votes, settings_, threadCount(settings_));
    ObjectStrengths found{std::vector<double>(codebook_->objects.size(), 0), maxima.size()};
    for (std::size_t object = 0; object < found.of_object.size(); ++object) {
      const VoteDensity density(scene.votes[object], settings_.voting.bandwidth);
      double& strongest = found.of_object[object];
      for (const ObjectMaximum& candidate : maxima) {
        if (candidate.object != object) continue;
        strongest = std::max(strongest, strength_[object] * density.at(candidate.maximum.position));
      }
    }
    return found;
  };
  return classifyIsolated(cloud, kind, *codebook_, match, settings_, strengths);
}

ViewKind testKind(const Codebook& codebook) {
  const auto is_model = [](const TrainingView& view) { return view.kind == ViewKind::model; };
  return std::all_of(codebook.views.begin(), codebook.views.end(), is_model) ? ViewKind::model : ViewKind::view;
}

}  // namespace sks
