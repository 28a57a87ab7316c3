// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/nearest_matches.hpp"

#include <memory>

namespace sks::baselines {

MatchFunction nearestMatches(const Codebook& codebook) {
  const auto matcher = std::make_shared<const Matcher>(codebook.descriptors);
  return [matcher](const DescriptorMatrix& descriptors, int threads) { return matcher->match(descriptors, threads); };
}

}  // namespace sks::baselines
