// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include <sks_detector/codebook.hpp>

#include "baselines/hypotheses.hpp"
#include "core/pipeline/isolated_object.hpp"

namespace sks::baselines {

/// Of each object the group of correspondences with most inliers, without verification.
/// @param threads that group
StrengthFunction groupStrengths(std::shared_ptr<const Codebook> codebook, Grouping grouping, int threads);

/// The highest peak of each object in PCL's implicit shape model (Knopp), which looks at descriptors and needs no
/// matches. Clusters the codewords before it returns.
/// @param settings of settingsFor()
StrengthFunction shapeModelStrengths(const Codebook& codebook, const Settings& settings, KnoppSettings own);

}  // namespace sks::baselines
