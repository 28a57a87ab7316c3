// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/classification.hpp>

#include <algorithm>
#include <tuple>

#include <sks_detector/mean_shift.hpp>

#include "core/hough_hypotheses.hpp"
#include "core/scene_description.hpp"
#include "core/stopwatch.hpp"

namespace sks {

std::vector<double> voteStrengths(const Codebook& codebook, ClassBalance balance) {
  std::vector<double> words(codebook.objects.size(), 0);
  for (const Codeword& word : codebook.words) words[codebook.views[word.view].object] += 1;
  std::vector<double> strength(words.size(), 1);
  if (balance == ClassBalance::none) return strength;
  for (std::size_t i = 0; i < words.size(); ++i) strength[i] = 1 / std::max(1.0, words[i]);
  return strength;
}

std::vector<Classification::Candidate> rankedCandidates(const std::vector<std::string>& objects,
                                                        const std::vector<double>& strengths) {
  double sum = 0;
  for (const double strength : strengths) sum += strength;
  std::vector<Classification::Candidate> candidates;
  for (std::size_t i = 0; i < strengths.size(); ++i) {
    if (strengths[i] > 0) candidates.push_back({objects[i], strengths[i] / sum});
  }
  std::sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
    return std::make_tuple(-a.score, std::cref(a.object)) < std::make_tuple(-b.score, std::cref(b.object));
  });
  return candidates;
}

Classifier::Classifier(std::shared_ptr<const Codebook> codebook, const Settings& settings, ClassBalance balance)
    : codebook_(std::move(codebook)),
      settings_(settingsFor(*codebook_, settings)),
      matcher_(codebook_->descriptors),
      strength_(voteStrengths(*codebook_, balance)) {}

Classification Classifier::classify(const Cloud& cloud, ViewKind kind) const {
  Classification result;
  Stopwatch total;
  const Orientation orientation = kind == ViewKind::model ? Orientation::outward : Orientation::sensor;
  const auto match = [this](const DescriptorMatrix& d, int threads) { return matcher_.match(d, threads); };
  const SceneDescription scene =
      describeScene(cloud, orientation, *codebook_, match, settings_, result.times, result.counts);

  Stopwatch stage;
  const std::vector<ObjectMaximum> maxima = findAllMaxima(scene.votes, settings_, threadCount(settings_));
  std::vector<double> strengths(codebook_->objects.size(), 0);
  for (const auto& [object, maximum] : maxima) {
    strengths[object] = std::max(strengths[object], strength_[object] * maximum.density);
  }
  result.candidates = rankedCandidates(codebook_->objects, strengths);
  result.counts.hypotheses = maxima.size();
  result.times.voting += stage.lap();
  result.times.total = total.lap();
  return result;
}

ViewKind testKind(const Codebook& codebook) {
  const auto is_model = [](const TrainingView& view) { return view.kind == ViewKind::model; };
  return std::all_of(codebook.views.begin(), codebook.views.end(), is_model) ? ViewKind::model : ViewKind::view;
}

}  // namespace sks
