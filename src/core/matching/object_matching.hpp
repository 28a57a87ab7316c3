// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <sks_detector/codebook.hpp>
#include <sks_detector/stages/matching.hpp>

namespace sks {

class NearestWord;

/// Finds for each descriptor the nearest codeword of all, and that of every other object that is nearly as near: where
/// objects resemble each other, or the nearest training view is far from the sensor's, the nearest of all often belongs
/// to another object. Exact up to 16,384 codewords, as Matcher. Immutable once built: match() may be called from
/// several threads.
class ObjectMatcher {
public:
  /// Keeps a reference to the descriptors' storage. @throws Error(bad_data) if they hold a negative or non-finite value
  explicit ObjectMatcher(const Codebook& codebook);

  /// @param ambiguity at least 1; codewords within this factor of the distance of the nearest of all are kept, at most
  ///        one for each object. 1: only the nearest of all, of equally near ones the first
  /// @param background words of no object; where one is nearer than all codewords, the ambiguity and the weights refer
  /// to
  ///        its distance. None: nullptr
  /// @return in the order of the queries, those of a query in the order of their objects; weights fall with the tenth
  ///         power of the distance
  /// @throws Error(incompatible) if the descriptors' sizes differ
  std::vector<Match> match(const DescriptorMatrix& queries, double ambiguity, int threads,
                           const NearestWord* background = nullptr) const;

private:
  std::size_t objects_ = 0;  // those with codewords: others cost nothing
  std::shared_ptr<const NearestWord> index_;
};

}  // namespace sks
