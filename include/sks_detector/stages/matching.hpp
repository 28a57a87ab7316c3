// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include <sks_detector/stages/descriptors.hpp>
#include <sks_detector/stages/quantized_descriptors.hpp>

namespace sks {

/// A scene descriptor and its nearest codeword.
struct Match {
  std::uint32_t descriptor;  ///< row in the scene's descriptors
  std::uint32_t word;        ///< row in the codebook's descriptors
  float distance;            ///< chi squared: sum (a-b)^2 / (a+b)
  float weight = 1;          ///< of its vote, in (0, 1]: 1 for the nearest codeword of all
};

/// Finds codewords for descriptors, with so many threads.
using MatchFunction = std::function<std::vector<Match>(const DescriptorMatrix&, int threads)>;

/// Chi squared distance of two histograms, in the order of the formula; bins with a + b = 0 add nothing.
double chiSquared(const float* a, const float* b, std::size_t size);

/// How nearest codewords are found; `automatic` is exact up to 16,384 codewords.
enum class SearchKind { automatic, exact, approximate };

bool searchesExactly(SearchKind search, std::size_t words);

/// Nearest neighbour under chi squared (docs/method.md). Immutable once built: match() may be called from several
/// threads.
class Matcher {
public:
  /// Keeps a reference to the descriptors' storage. An approximate search finds nearly all of the nearest words, in a
  /// time that hardly grows with their number.
  /// @throws Error(bad_data) if the descriptors hold a negative or non-finite value
  explicit Matcher(DescriptorMatrix words, SearchKind search = SearchKind::automatic);
  explicit Matcher(QuantizedDescriptors words, SearchKind search = SearchKind::automatic);
  ~Matcher();
  Matcher(Matcher&&) noexcept;
  Matcher& operator=(Matcher&&) noexcept;

  /// One match for each query, in their order; of equally near words the first. Empty if there are no words. The same
  /// for any number of threads, and for any other queries.
  /// @throws Error(incompatible) if the descriptors' sizes differ
  std::vector<Match> match(const DescriptorMatrix& queries, int threads) const;

private:
  struct Index;
  std::unique_ptr<Index> index_;
};

}  // namespace sks
