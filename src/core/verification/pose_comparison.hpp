// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/settings.hpp>

#include "core/verification/model_surface.hpp"
#include "core/verification/pose_evidence.hpp"
#include "core/verification/sight_lines.hpp"

namespace sks {

/// Chooses between poses of one object that differ by a turn, by the Dice coefficient of what each shows and what the
/// scene shows of the object. Evidence favours a mug that hides its handle, as a handle is thin and badly seen.
class PoseComparison {
public:
  /// @param model, scene, settings must outlive this @param object_size largest extent of the object's box [m]
  PoseComparison(const ModelSurface& model, const SceneView& scene, const VerificationSettings& settings,
                 double object_size);

  /// Looks at a pose; its number, from 0 on. @param factor of its agreement, for what else is known of it
  std::size_t add(const Eigen::Isometry3d& T_scene_model, double factor = 1);
  /// In [0, 1]: twice the rays that agree in place and colour, over those to what pose `i` shows and those that met the
  /// scene in the pose, of all so far, that meets most of it.
  double agreement(std::size_t i) const;
  /// The numbers of the poses that agree most, the best first; at most so many. The first of equals.
  std::vector<std::size_t> ranked(std::size_t most) const;

private:
  const ModelSurface& model_;
  const SceneView& scene_;
  const VerificationSettings& settings_;
  float object_size_;
  std::vector<RayAgreement> poses_;
  std::vector<double> factors_;
  double most_met_ = 0;  // rays
};

}  // namespace sks
