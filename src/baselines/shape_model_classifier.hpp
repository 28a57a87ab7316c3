// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include <sks_detector/classification.hpp>

#include "baselines/method_settings.hpp"

namespace sks::baselines {

/// Classifies isolated objects by PCL's implicit shape model, trained on the codewords of a codebook (Knopp).
/// Immutable: may be called from several threads.
class ShapeModelClassifier {
public:
  /// Clusters the codewords. @throws Error(bad_usage), Error(incompatible) like Classifier
  ShapeModelClassifier(std::shared_ptr<const Codebook> codebook, const Settings& settings, const KnoppSettings& own);
  ~ShapeModelClassifier();

  /// @throws like Classifier::classify()
  Classification classify(const Cloud& cloud, ViewKind kind) const;

private:
  struct ShapeModel;

  std::shared_ptr<const Codebook> codebook_;
  Settings settings_;
  KnoppSettings own_;
  std::unique_ptr<const ShapeModel> model_;
};

}  // namespace sks::baselines
