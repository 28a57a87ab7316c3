// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/matching/code_table.hpp"
#include "core/matching/hellinger_axes.hpp"
#include "core/matching/searched_words.hpp"

namespace sks {

/// Codes histograms by 16-bit coordinates on Hellinger axes, so that codeDistances() are lower bounds of chi squared.
class WordCodes {
public:
  struct CodedQuery {
    CodedVector vector;
    float slack;  ///< how far rounding may lift bounds above distances
  };

  WordCodes() = default;
  explicit WordCodes(const SearchedWords& words);

  /// Codes of all words; what is encoded as a query afterwards allows for their rounding.
  std::vector<CodedVector> encode(const SearchedWords& words);

  /// Of the size that squared distances of words have.
  float usualDistance() const { return axes_.meanMass() + floor_; }

  /// @param projection a buffer
  void encode(const float* histogram, HellingerAxes::Projection& projection, CodedQuery& query) const;

private:
  void encode(const HellingerAxes::Projection& projection, CodedVector& vector) const;

  HellingerAxes axes_;
  float floor_ = 0;         // added to the square of what the axes leave over
  float longest_ = 0;       // vector of coordinates of a word
  float largest_mass_ = 0;  // of a word
};

}  // namespace sks
