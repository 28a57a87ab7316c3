// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <sks_detector/descriptors.hpp>

namespace sks {

/// A scene descriptor and its nearest codeword.
struct Match {
  std::uint32_t descriptor;  ///< row in the scene's descriptors
  std::uint32_t word;        ///< row in the codebook's descriptors
  float distance;            ///< chi squared: sum (a-b)^2 / (a+b)
};

/// Chi squared distance of two histograms, in the order of the formula; bins with a + b = 0 add nothing.
double chiSquared(const float* a, const float* b, std::size_t size);

/// Exact nearest neighbour under chi squared by a cascade of lower bounds (docs/method.md). Immutable once built:
/// match() may be called from several threads.
class Matcher {
public:
  /// Keeps a reference to the descriptors' storage. @throws Error(bad_data) if they hold a negative or non-finite value
  explicit Matcher(DescriptorMatrix words);
  ~Matcher();
  Matcher(Matcher&&) noexcept;
  Matcher& operator=(Matcher&&) noexcept;

  /// One match for each query, in their order; of equally near words the first. Empty if there are no words.
  /// @throws Error(incompatible) if the descriptors' sizes differ
  std::vector<Match> match(const DescriptorMatrix& queries, int threads) const;

private:
  struct Index;
  std::unique_ptr<Index> index_;
};

}  // namespace sks
