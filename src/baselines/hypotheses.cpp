// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/hypotheses.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "core/verification/refinement.hpp"

namespace sks::baselines {
namespace {

/// The view that most of the inliers belong to; of equals the first.
std::uint32_t mainView(const Codebook& codebook, const FramedModel& model, const Group& group) {
  std::map<std::uint32_t, std::size_t> counts;
  for (const pcl::Correspondence& pair : group.inliers) {
    ++counts[codebook.words[model.words[std::size_t(pair.index_query)]].view];
  }
  const auto fewer = [](const auto& a, const auto& b) { return a.second < b.second; };
  return std::max_element(counts.begin(), counts.end(), fewer)->first;
}

RatedHypothesis hypothesisOf(const Codebook& codebook, const FramedModel& model, const Group& group) {
  Hypothesis hypothesis;
  hypothesis.object = model.object;
  hypothesis.view = mainView(codebook, model, group);
  hypothesis.T_scene_model = group.T_scene_model;
  const TrainingView& view = codebook.views[hypothesis.view];
  hypothesis.T_scene_box = group.T_scene_model * Eigen::Translation3d(view.center().cast<double>());
  hypothesis.box_size = view.extent().cast<double>();
  hypothesis.votes = std::uint32_t(model.words.size());
  for (const pcl::Correspondence& pair : group.inliers) hypothesis.inliers.push_back(std::uint32_t(pair.index_match));
  return {hypothesis, double(group.inliers.size())};
}

void sortByRating(std::vector<RatedHypothesis>& hypotheses) {
  std::stable_sort(hypotheses.begin(), hypotheses.end(),
                   [](const RatedHypothesis& a, const RatedHypothesis& b) { return a.support > b.support; });
}

}  // namespace

std::vector<RatedHypothesis> groupedHypotheses(const Codebook& codebook, const FramedModels& models,
                                               const SceneDescription& scene, const Grouping& grouping, int threads) {
  const FramedKeypoints keypoints = describedKeypoints(scene);
  const std::vector<FramedModel> matched = models.matched(codebook, scene.matches);
  std::vector<std::vector<Group>> groups(matched.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t i = 0; i < matched.size(); ++i) groups[i] = grouping(matched[i], keypoints);
  std::vector<RatedHypothesis> hypotheses;
  for (std::size_t i = 0; i < matched.size(); ++i) {
    for (const Group& group : groups[i]) hypotheses.push_back(hypothesisOf(codebook, matched[i], group));
  }
  sortByRating(hypotheses);
  return hypotheses;
}

std::vector<RatedHypothesis> withoutDuplicates(std::vector<RatedHypothesis> hypotheses, double distance) {
  sortByRating(hypotheses);
  std::vector<RatedHypothesis> kept;
  for (RatedHypothesis& candidate : hypotheses) {
    const auto same = [&](const RatedHypothesis& other) {
      const Hypothesis &a = candidate.hypothesis, &b = other.hypothesis;
      return a.object == b.object && (a.T_scene_box.translation() - b.T_scene_box.translation()).norm() < distance;
    };
    if (std::none_of(kept.begin(), kept.end(), same)) kept.push_back(std::move(candidate));
  }
  return kept;
}

void refine(const Codebook& codebook, const Surface& scene, const RefinementSettings& settings,
            Hypothesis& hypothesis) {
  const TrainingView& view = codebook.views[hypothesis.view];
  const Eigen::Isometry3d T_model_box = hypothesis.T_scene_model.inverse() * hypothesis.T_scene_box;
  hypothesis.T_scene_model =
      refinePose(view.surface_points, view.surface_normals, scene, settings, hypothesis.T_scene_model);
  hypothesis.T_scene_box = hypothesis.T_scene_model * T_model_box;
}

}  // namespace sks::baselines
