// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <sks_detector/descriptors.hpp>

#include "core/code_table.hpp"
#include "core/hellinger_axes.hpp"

namespace sks {

/// Lower bounds of the chi squared distances to whole blocks of words, from 16-bit coordinates on Hellinger axes.
class WordCodes {
public:
  struct CodedQuery {
    CodedVector vector;
    float slack;  ///< how far rounding may lift bounds above distances
  };

  WordCodes() = default;
  /// @param order the word of each slot; slots are what blocks are made of
  WordCodes(const DescriptorMatrix& words, const std::vector<std::uint32_t>& order);

  const CodeTable& table() const { return table_; }

  /// @param projection a buffer
  /// @param projection a buffer
  void encode(const float* histogram, HellingerAxes::Projection& projection, CodedQuery& query) const;

private:
  void encode(const HellingerAxes::Projection& projection, CodedVector& vector) const;

  HellingerAxes axes_;
  float floor_ = 0;         // added to the square of what the axes leave over
  float longest_ = 0;       // vector of coordinates of a word
  float largest_mass_ = 0;  // of a word
  CodeTable table_;
};

}  // namespace sks
