// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <Eigen/Geometry>

#include <sks_detector/settings.hpp>

#include "core/verification/model_surface.hpp"
#include "core/verification/pose_evidence.hpp"

namespace sks {

/// What the sensor's own rays say to a model in a pose: a stricter look than that for evidence, which takes a scene
/// point from anywhere around. In noise and clutter some point near by always has the right normal.
struct SightLines {
  double confirmed = 0;  ///< rays to the visible surface of the model that met the scene there, with its normal
  double missed = 0;     ///< rays that met something else; half where nothing was measured
  /// Rays just beyond the model's outline where the scene ends or bends too; half where nothing was measured.
  double ends = 0;
  double goes_on = 0;  ///< ... where the scene's surface goes on: the model is a piece of something larger
  /// Median difference in colour, scene less model, over the confirmed rays; as in Surface. None without colour.
  std::optional<Eigen::Vector3f> color_shift;
  double pattern = 1;  ///< agreement of the colours' patterns over the confirmed rays, in (0, 1]; of an exact pose

  /// Of rays and outline, in (0, 1]: the evidence is multiplied by it.
  double agreement() const;
};

/// Looks along the rays to all of the model that is not occluded by itself or by the scene. Scene points on planes
/// larger than the object are passed over.
/// @param object_size largest extent of the object's box [m]
SightLines lookAlongRays(const ModelSurface& model, const SceneView& scene, const VerificationSettings& settings,
                         const Eigen::Isometry3d& T_scene_model, float object_size);

/// How well a model in a pose and the scene agree along the rays (PoseComparison).
struct RayAgreement {
  double rays = 0;  ///< to the visible surface of the model; half where nothing was measured
  double met = 0;   ///< of these, that met the scene there
  /// The same, by how much colours agree; half where the normal differs, as it does on thin parts.
  double agreeing = 0;
  double pattern = 1;  ///< as in SightLines
};

/// Arguments as of lookAlongRays().
RayAgreement agreementAlongRays(const ModelSurface& model, const SceneView& scene, const VerificationSettings& settings,
                                const Eigen::Isometry3d& T_scene_model, float object_size);

}  // namespace sks
