// SPDX-License-Identifier: BSD-3-Clause
#include "core/voting/hough_hypotheses.hpp"

#include "core/verification/refinement.hpp"
#include "core/voting/mean_shift.hpp"

namespace sks {
namespace {

void refine(std::vector<Hypothesis>& hypotheses, const Codebook& codebook, const Surface& scene,
            const RefinementSettings& settings, int threads) {
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t i = 0; i < hypotheses.size(); ++i) {
    Hypothesis& hypothesis = hypotheses[i];
    if (hypothesis.density < settings.min_density) continue;
    const TrainingView& view = codebook.views[hypothesis.view];
    const Eigen::Isometry3d T_model_box = hypothesis.T_scene_model.inverse() * hypothesis.T_scene_box;
    hypothesis.T_scene_model =
        refinePose(view.surface_points, view.surface_normals, scene, settings, hypothesis.T_scene_model);
    hypothesis.T_scene_box = hypothesis.T_scene_model * T_model_box;
  }
}

}  // namespace

std::vector<ObjectMaximum> findAllMaxima(const std::vector<std::vector<Vote>>& spaces, const Settings& settings,
                                         int threads) {
  std::vector<std::vector<Maximum>> by_object(spaces.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t object = 0; object < spaces.size(); ++object) {
    std::vector<Eigen::Vector3f> positions;
    for (const Vote& vote : spaces[object]) positions.push_back(vote.position);
    by_object[object] = findMaxima(positions, settings.voting);
    const std::size_t limit = std::size_t(settings.detection.max_per_object);
    if (by_object[object].size() > limit) by_object[object].resize(limit);
  }
  std::vector<ObjectMaximum> maxima;
  for (std::size_t object = 0; object < by_object.size(); ++object) {
    for (Maximum& maximum : by_object[object]) maxima.push_back({std::uint32_t(object), std::move(maximum)});
  }
  return maxima;
}

std::vector<Hypothesis> houghHypotheses(const Codebook& codebook, const std::vector<std::vector<Vote>>& spaces,
                                        const std::vector<ObjectMaximum>& maxima, const Surface& scene,
                                        const Settings& settings, int threads) {
  std::vector<Hypothesis> hypotheses;
  for (const auto& [object, maximum] : maxima) {
    Hypothesis hypothesis;
    if (estimateHypothesis(codebook, object, spaces[object], maximum, settings, hypothesis)) {
      hypotheses.push_back(std::move(hypothesis));
    }
  }
  if (settings.refinement.iterations > 0) refine(hypotheses, codebook, scene, settings.refinement, threads);
  return hypotheses;
}

}  // namespace sks
