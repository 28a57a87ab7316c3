// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <sks_detector/codebook.hpp>
#include <sks_detector/settings.hpp>
#include <sks_detector/stages/hypothesis.hpp>

#include "core/verification/model_surface.hpp"
#include "core/verification/pose_comparison.hpp"
#include "core/verification/pose_evidence.hpp"
#include "core/verification/resting_poses.hpp"
#include "core/verification/rough_support.hpp"
#include "core/verification/sight_lines.hpp"
#include "core/voting/vote_density.hpp"

namespace sks {

/// An object in one of its resting poses.
struct RestingModel {
  std::uint32_t object = 0;
  const ModelSurface* surface = nullptr;
  RestingPose rest;
};

/// What verification keeps of a codebook: made once, read by every scene.
struct VerifiedModels {
  /// The same for any number of threads.
  VerifiedModels(std::shared_ptr<const Codebook> codebook, int threads);

  /// Width of the thinnest stick among the objects [m]; 0: there is none.
  float stickWidth() const;

  std::shared_ptr<const Codebook> codebook;
  std::vector<std::shared_ptr<const ModelSurface>> surfaces;  ///< in the frame of each view
  WeightsOfViews weights;                                     ///< of the points of each view's stored surface
  std::vector<RoughSurface> rough;                            ///< of each view, for a quick look
  std::vector<RestingModel> resting;                          ///< of the objects that are known from all sides
};

/// Of the views that a surface is made of the one that was taken most nearly from where the sensor is now.
std::uint32_t nearestView(const ModelSurface& surface, const Eigen::Vector3f& sensor_origin,
                          const Eigen::Isometry3d& T_scene_model);

/// A hypothesis with its evidence, and the part of the scene that it explains.
struct Examined {
  Hypothesis hypothesis;
  std::vector<std::uint32_t> confirming;  ///< scene points
  SightLines lines;
};

/// Gives poses their evidence in one scene (docs/method.md, section 11). Thread-safe while the scene is not changed.
class PoseExaminer {
public:
  /// @param spaces votes for each object; all that is passed must outlive this
  PoseExaminer(const VerifiedModels& models, const SceneView& scene, const std::vector<std::vector<Vote>>& spaces,
               const Settings& settings);

  /// The evidence of a pose of a view by a quick look: with wide tolerances more than it will have, as a rule.
  /// @param stands as in Hypothesis
  double roughEvidence(std::uint32_t object, std::uint32_t view, bool stands, const Eigen::Isometry3d& T_scene_model,
                       const RoughSupport& support) const;
  /// A first look at few points, along the sensor's rays: evidence without sight lines. Nothing is told of what
  /// confirms it.
  Examined examineAlongRays(Hypothesis hypothesis) const;
  /// The evidence of a pose that is about right, to choose between poses.
  Examined examineRoughly(Hypothesis hypothesis) const;
  /// The evidence of an exact pose, in which the patterns of colours must agree too.
  /// @param areas where given, takes what the scene says to the surface
  Examined examine(Hypothesis hypothesis, PoseEvidence* areas = nullptr) const;
  /// After some last rounds of ICP with nearest points.
  Hypothesis refined(Hypothesis hypothesis) const;
  /// Of a pose and those of turnedPoses(), that which agrees most (PoseComparison). Only where a model is known from
  /// all sides and colours are compared.
  Hypothesis bestTurned(const Hypothesis& hypothesis) const;
  /// The pose of an examined hypothesis fitted by many points of the whole model, where the model is known from all
  /// sides; where no colours are compared, the best of those turned as in bestTurned(). Its evidence stays. With the
  /// covariance of the pose.
  Hypothesis finished(const Hypothesis& hypothesis) const;

  /// Hypothesis::covariance of a pose.
  Eigen::Matrix<double, 6, 6> covarianceOf(const Hypothesis& hypothesis) const;

private:
  Hypothesis bestFitted(const Hypothesis& hypothesis) const;
  Hypothesis fitted(Hypothesis hypothesis) const;
  /// Of a pose and those turned around it, after a fit, that which agrees most with what they explain together: a mug
  /// that hides its handle would else agree with any mug.
  template <typename Fit>
  Hypothesis bestOfTurned(const Hypothesis& hypothesis, Fit&& fit) const;
  /// Where no colours are compared: how well the surface fits, with its outline; a larger area says nothing here.
  /// Else 1.
  double shapeFactor(const Hypothesis& hypothesis) const;
  PoseComparison comparisonFor(const Hypothesis& hypothesis) const;
  /// Turns a pose, `number` of the comparison, between those that turnedPoses() tries about the axis of a body: where
  /// only colours tell it, no fit finds it.
  void turnFinely(Hypothesis& hypothesis, std::size_t number, const BodyAxis& body, PoseComparison& comparison) const;
  /// A fitted pose, or the same with the turn about the axis of its body that it had before, as the scene agrees more:
  /// the shape of a can says nothing of its turn, and a fit lets it drift.
  Hypothesis withBetterTurn(const Hypothesis& before, Hypothesis fitted) const;
  std::vector<Hypothesis> turnedAround(const Hypothesis& hypothesis) const;
  double evidenceAt(Hypothesis& hypothesis, PoseEvidence& pose, std::size_t most_points,
                    CorrespondenceSearch search) const;
  void place(Hypothesis& hypothesis) const;
  double evidenceOf(const PoseEvidence& pose, std::uint32_t view, bool stands, const Eigen::Vector3f& center,
                    double density) const;
  SightLines sightLines(const Hypothesis& hypothesis) const;
  double sampling(const Eigen::Vector3f& position) const;

  const VerifiedModels& models_;
  const Codebook& codebook_;
  const SceneView& scene_;
  const Settings& settings_;
  std::vector<std::optional<VoteDensity>> densities_;  // of each object that has votes
};

}  // namespace sks
