// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/group_classifier.hpp"

#include <algorithm>
#include <utility>

#include "core/scene_description.hpp"
#include "core/stopwatch.hpp"

namespace sks::baselines {

GroupClassifier::GroupClassifier(std::shared_ptr<const Codebook> codebook, const Settings& settings, Grouping grouping)
    : codebook_(std::move(codebook)),
      settings_(settingsFor(*codebook_, settings)),
      matcher_(codebook_->descriptors),
      models_(*codebook_),
      grouping_(std::move(grouping)) {}

Classification GroupClassifier::classify(const Cloud& cloud, ViewKind kind) const {
  Classification result;
  Stopwatch total;
  const Orientation orientation = kind == ViewKind::model ? Orientation::outward : Orientation::sensor;
  const auto match = [this](const DescriptorMatrix& d, int threads) { return matcher_.match(d, threads); };
  const SceneDescription scene =
      describeScene(cloud, orientation, *codebook_, match, settings_, result.times, result.counts);

  Stopwatch stage;
  const auto hypotheses = groupedHypotheses(*codebook_, models_, scene, grouping_, threadCount(settings_));
  std::vector<double> strengths(codebook_->objects.size(), 0);
  for (const auto& [hypothesis, support] : hypotheses) {
    strengths[hypothesis.object] = std::max(strengths[hypothesis.object], support);
  }
  result.candidates = rankedCandidates(codebook_->objects, strengths);
  result.counts.hypotheses = hypotheses.size();
  result.times.voting += stage.lap();
  result.times.total = total.lap();
  return result;
}

}  // namespace sks::baselines
