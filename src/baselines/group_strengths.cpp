// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>

#include "baselines/object_strengths.hpp"

namespace sks::baselines {

StrengthFunction groupStrengths(std::shared_ptr<const Codebook> codebook, Grouping grouping, int threads) {
  const FramedModels models(*codebook);
  return
      [codebook = std::move(codebook), models, grouping = std::move(grouping), threads](const SceneDescription& scene) {
        const auto hypotheses = groupedHypotheses(*codebook, models, scene, grouping, threads);
        ObjectStrengths strengths{std::vector<double>(codebook->objects.size(), 0), hypotheses.size()};
        for (const Hypothesis& hypothesis : hypotheses) {
          double& strength = strengths.of_object[hypothesis.object];
          strength = std::max(strength, hypothesis.density);
        }
        return strengths;
      };
}

}  // namespace sks::baselines
