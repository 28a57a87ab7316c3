// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include <sks_detector/codebook.hpp>
#include <sks_detector/settings.hpp>
#include <sks_detector/stages/quantized_descriptors.hpp>

#include "core/matching/nearest_word.hpp"

namespace sks {

/// SHOT descriptors of backgroundViews(), as a codebook with these settings holds them: what a descriptor of a scene
/// resembles where it belongs to none of the objects. Those of the last settings are remembered: a robot's codebooks
/// mostly have the same. Deterministic, thread-safe. @return no rows if the settings leave no descriptor
/// @throws Error(bad_usage) where threads cannot be started
QuantizedDescriptors backgroundDescriptors(const Settings& settings);

/// To be searched with these settings: those that the codebook keeps, where they are the same, else those of the
/// settings. The last ones are remembered. Thread-safe. @return nullptr if the settings leave no descriptor
/// @throws Error(bad_usage) where threads cannot be started
std::shared_ptr<const NearestWord> backgroundWords(const Codebook& codebook, const Settings& settings);

}  // namespace sks
