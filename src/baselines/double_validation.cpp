// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/hypotheses.hpp"
#include "core/verification/refinement.hpp"

namespace sks::baselines {
namespace {

/// The fraction of the stored surface facing the sensor that lies within `distance` of scene points.
double supportedFraction(const TrainingView& view, const Surface& scene, const Eigen::Isometry3d& T_scene_model,
                         double distance) {
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  std::size_t facing = 0, supported = 0;
  std::vector<PointGrid::Run> runs;
  for (std::size_t i = 0; i < view.surface_points.size(); ++i) {
    const Eigen::Vector3f p = T * view.surface_points[i], n = T.linear() * view.surface_normals[i];
    if (n.dot(scene.sensor_origin - p) <= 0) continue;
    ++facing;
    bool near = false;
    scene.forEachNeighbor(p, float(distance), runs, [&](std::uint32_t, float) { near = true; });
    supported += near ? 1 : 0;
  }
  return facing == 0 ? 0 : double(supported) / double(facing);
}

}  // namespace

HypothesisCheck doubleValidation(std::shared_ptr<const Codebook> codebook, const ZhouSettings& settings,
                                 const RefinementSettings& refinement, int threads) {
  RefinementSettings first = refinement, second = refinement;
  first.end_distance = second.start_distance = 0.5 * (refinement.start_distance + refinement.end_distance);
  first.iterations = (refinement.iterations + 1) / 2;
  second.iterations = refinement.iterations - first.iterations;
  return [=](std::vector<Hypothesis> hypotheses, const Surface& scene) {
    std::vector<double> fractions(hypotheses.size(), 0);
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
    for (std::size_t i = 0; i < hypotheses.size(); ++i) {
      Hypothesis& hypothesis = hypotheses[i];
      const auto fraction = [&] {
        return supportedFraction(codebook->views[hypothesis.view], scene, hypothesis.T_scene_model,
                                 settings.support_distance);
      };
      refine(hypothesis, *codebook, scene, first);
      if (fraction() < settings.first_support) continue;
      refine(hypothesis, *codebook, scene, second);
      if (fraction() >= settings.second_support) fractions[i] = fraction();
    }
    std::vector<Hypothesis> valid;
    for (std::size_t i = 0; i < hypotheses.size(); ++i) {
      if (fractions[i] <= 0) continue;
      hypotheses[i].density *= fractions[i];
      valid.push_back(std::move(hypotheses[i]));
    }
    return valid;
  };
}

}  // namespace sks::baselines
