// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/verification/pose_examiner.hpp"

namespace sks {

/// As many good hypotheses it takes to tell light from a wrong object.
constexpr double color_doubt = 2;

/// By what exposure and white balance have moved the colours of a scene from those of the models: the median of the
/// shifts that the hypotheses see, weighted by their evidence, scene less model; as in Surface. Bounded.
/// @param doubt evidence that speaks for no shift; hypotheses with less than half of it have no say
Eigen::Vector3f sceneColorShift(const std::vector<Examined>& examined, double doubt);

}  // namespace sks
