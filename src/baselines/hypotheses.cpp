// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/hypotheses.hpp"

#include <algorithm>
#include <utility>

#include "core/voting/main_view.hpp"

namespace sks::baselines {
namespace {

Hypothesis hypothesisOf(const Codebook& codebook, const FramedModel& model, const Group& group) {
  std::vector<std::uint32_t> words;
  for (const pcl::Correspondence& pair : group.inliers) words.push_back(model.words[std::size_t(pair.index_query)]);
  Hypothesis hypothesis;
  hypothesis.object = model.object;
  hypothesis.view = mainView(codebook, words);
  hypothesis.T_scene_model = group.T_scene_model;
  const TrainingView& view = codebook.views[hypothesis.view];
  hypothesis.T_scene_box = group.T_scene_model * Eigen::Translation3d(view.center().cast<double>());
  hypothesis.box_size = view.extent().cast<double>();
  hypothesis.votes = std::uint32_t(model.words.size());
  for (const pcl::Correspondence& pair : group.inliers) hypothesis.inliers.push_back(std::uint32_t(pair.index_match));
  hypothesis.density = double(group.inliers.size());
  return hypothesis;
}

void sortBySupport(std::vector<Hypothesis>& hypotheses) {
  std::stable_sort(hypotheses.begin(), hypotheses.end(),
                   [](const Hypothesis& a, const Hypothesis& b) { return a.density > b.density; });
}

}  // namespace

std::vector<Hypothesis> groupedHypotheses(const Codebook& codebook, const FramedModels& models,
                                          const SceneDescription& scene, const Grouping& grouping, int threads) {
  const FramedKeypoints keypoints = describedKeypoints(scene);
  const std::vector<FramedModel> matched = models.matched(codebook, scene.matches);
  std::vector<std::vector<Group>> groups(matched.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t i = 0; i < matched.size(); ++i) groups[i] = grouping(matched[i], keypoints);
  std::vector<Hypothesis> hypotheses;
  for (std::size_t i = 0; i < matched.size(); ++i) {
    for (const Group& group : groups[i]) hypotheses.push_back(hypothesisOf(codebook, matched[i], group));
  }
  sortBySupport(hypotheses);
  return hypotheses;
}

std::vector<Hypothesis> withoutDuplicates(std::vector<Hypothesis> hypotheses, double distance) {
  sortBySupport(hypotheses);
  std::vector<Hypothesis> kept;
  for (Hypothesis& candidate : hypotheses) {
    const auto same = [&](const Hypothesis& other) {
      const double apart = (candidate.T_scene_box.translation() - other.T_scene_box.translation()).norm();
      return candidate.object == other.object && apart < distance;
    };
    if (std::none_of(kept.begin(), kept.end(), same)) kept.push_back(std::move(candidate));
  }
  return kept;
}

}  // namespace sks::baselines
