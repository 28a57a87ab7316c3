// SPDX-License-Identifier: BSD-3-Clause
// What all classifiers of isolated objects have in common: describing the cloud and ranking the objects.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "core/pipeline/classifier.hpp"
#include "core/pipeline/scene_description.hpp"

namespace sks {

/// How strongly a described cloud speaks for each object.
struct ObjectStrengths {
  std::vector<double> of_object;  ///< one for each object of the codebook; 0: no hypothesis
  std::size_t hypotheses = 0;
};

/// May be called from several threads.
using StrengthFunction = std::function<ObjectStrengths(const SceneDescription&)>;

/// Describes a cloud and ranks the objects by their strengths. @throws like Classifier::classify()
Classification classifyIsolated(const Cloud& cloud, ViewKind kind, const SceneDescriber& describer,
                                const StrengthFunction& strengths);

}  // namespace sks
