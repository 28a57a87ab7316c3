// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/hypotheses.hpp"
#include "baselines/pcl_global_verification.hpp"
#include "core/verification/range_image.hpp"
#include "core/verification/refinement.hpp"

namespace sks::baselines {
namespace {

HvPoint toPcl(const Eigen::Vector3f& position, const Eigen::Vector3f& normal) {
  HvPoint point;
  point.getVector3fMap() = position;
  point.getNormalVector3fMap() = normal;
  return point;
}

/// A hypothesis' stored surface in the frame of the sensor, from which PCL orients the scene's normals.
struct PlacedSurface {
  HvCloud::Ptr visible{new HvCloud};
  HvCloud::Ptr complete{new HvCloud};
};

PlacedSurface placedSurface(const TrainingView& view, const Hypothesis& hypothesis, const Surface& scene,
                            const RangeImage& range_image, double occlusion_distance) {
  PlacedSurface placed;
  const Eigen::Isometry3f T = hypothesis.T_scene_model.cast<float>();
  for (std::size_t i = 0; i < view.surface_points.size(); ++i) {
    const Eigen::Vector3f p = T * view.surface_points[i], n = T.linear() * view.surface_normals[i];
    const HvPoint point = toPcl(p - scene.sensor_origin, n);
    placed.complete->push_back(point);
    const bool faces = n.dot(scene.sensor_origin - p) > 0;
    if (faces && range_image.look(p, float(occlusion_distance)).sight != Sight::occluded)
      placed.visible->push_back(point);
  }
  return placed;
}

HvCloud::Ptr sceneCloud(const Surface& scene) {
  HvCloud::Ptr cloud(new HvCloud);
  for (std::size_t i = 0; i < scene.size(); ++i) {
    if (scene.normal(i).allFinite()) cloud->push_back(toPcl(scene.point(i) - scene.sensor_origin, scene.normal(i)));
  }
  return cloud;
}

void configure(pcl::GlobalHypothesesVerification<HvPoint, HvPoint>& verification, const AldomaSettings& settings) {
  verification.setResolution(float(settings.resolution));
  verification.setInlierThreshold(float(settings.inlier_distance));
  verification.setRegularizer(float(settings.outlier_weight));
  verification.setClutterRegularizer(float(settings.clutter_weight));
  verification.setRadiusClutter(float(settings.clutter_radius));
  verification.setRadiusNormals(float(settings.normal_radius));
  verification.setDetectClutter(true);
  verification.setInitialTemp(float(settings.annealing_steps));
  verification.setMaxIterations(settings.annealing_steps);
}

}  // namespace

HypothesisCheck globalVerification(const std::shared_ptr<const Codebook>& codebook, const AldomaSettings& settings,
                                   const RefinementSettings& refinement, int threads) {
  return [=](std::vector<Hypothesis> hypotheses, const Surface& scene) {
    if (hypotheses.size() > std::size_t(settings.hypotheses)) hypotheses.resize(std::size_t(settings.hypotheses));
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
    for (std::size_t i = 0; i < hypotheses.size(); ++i) refine(hypotheses[i], *codebook, scene, refinement);
    hypotheses = withoutDuplicates(std::move(hypotheses), settings.inlier_distance);  // what ICP took to one position
    if (hypotheses.empty()) return hypotheses;

    std::vector<PlacedSurface> placed(hypotheses.size());
    const RangeImage range_image(scene, float(settings.normal_radius));
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
    for (std::size_t i = 0; i < hypotheses.size(); ++i) {
      const Hypothesis& hypothesis = hypotheses[i];
      placed[i] =
          placedSurface(codebook->views[hypothesis.view], hypothesis, scene, range_image, settings.occlusion_distance);
    }
    std::vector<HvCloud::ConstPtr> visible, complete;
    for (const PlacedSurface& surface : placed) {
      visible.push_back(surface.visible);
      complete.push_back(surface.complete);
    }

    annealing_moves.seed(1);
    pcl::GlobalHypothesesVerification<HvPoint, HvPoint> verification;
    configure(verification, settings);
    const HvCloud::Ptr cloud = sceneCloud(scene);
    verification.setSceneCloud(cloud);
    verification.setOcclusionCloud(cloud);
    verification.addCompleteModels(complete);
    verification.addModels(visible);
    verification.verify();
    std::vector<bool> accepted;
    verification.getMask(accepted);
    std::vector<Hypothesis> kept;
    for (std::size_t i = 0; i < hypotheses.size(); ++i) {
      if (accepted[i]) kept.push_back(std::move(hypotheses[i]));
    }
    return kept;
  };
}

}  // namespace sks::baselines
