// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <sks_detector/cloud.hpp>
#include <sks_detector/codebook.hpp>
#include <sks_detector/detection.hpp>
#include <sks_detector/settings.hpp>

#include "core/pipeline/scene_description.hpp"

namespace sks {

/// What an isolated object is taken for.
struct Classification {
  struct Candidate {
    std::string object;  ///< name
    double score = 0;    ///< strength of its best hypothesis as a fraction of that of all objects' best, in (0, 1]
  };

  std::vector<Candidate> candidates;  ///< objects with a hypothesis, strongest first; ties by name
  StageTimes times;                   ///< [s]
  StageCounts counts;

  /// Name of the strongest candidate; empty where there is no hypothesis at all.
  std::string object() const { return candidates.empty() ? std::string() : candidates.front().object; }
};

/// How the Hough maxima of different objects are compared.
enum class ClassBalance {
  none,      ///< by their density alone, as published
  codewords  ///< by density over the root of the object's codewords: who has more of them catches more votes by chance,
             ///< but also more of those that are right
};

/// Classifies isolated objects by the strongest hypothesis: no RANSAC, no verification, since another shape of the same
/// class fits no rigid pose. Immutable: classify() may be called from several threads. Same cloud, same result, for any
/// number of threads.
class Classifier {
public:
  /// @throws Error(bad_usage) for invalid settings, Error(incompatible) naming keys and values in which `settings`
  ///         differ from what the codebook was trained with
  Classifier(std::shared_ptr<const Codebook> codebook, const Settings& settings, ClassBalance balance);

  /// @param kind view: seen from the sensor's origin; model: full 3-D, whose normals point outwards
  /// @throws Error(bad_data) for an unusable cloud, Error(incompatible) for a cloud without colour with CSHOT
  Classification classify(const Cloud& cloud, ViewKind kind) const;

private:
  SceneDescriber describer_;
  std::vector<double> strength_;  ///< of one vote, for each object
};

/// What the clouds of a classification set must be, from what its codebook was trained with: full models where all
/// training clouds are, else views.
ViewKind testKind(const Codebook& codebook);

/// Whatever classifies a cloud, for example a Classifier. May throw Error.
using ClassifyFunction = std::function<Classification(const Cloud&)>;

}  // namespace sks
