// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include <sks_detector/settings.hpp>

#include "core/matching/nearest_word.hpp"

namespace sks {

/// SHOT descriptors of backgroundViews(), as a codebook with these settings would hold them: what a descriptor of a
/// scene resembles where it belongs to none of the objects. Those of the last settings are remembered: a robot's
/// codebooks mostly have the same. Deterministic, thread-safe. @return nullptr if the settings leave no descriptor
/// @throws Error(bad_usage) where threads cannot be started
std::shared_ptr<const NearestWord> backgroundWords(const Settings& settings);

}  // namespace sks
