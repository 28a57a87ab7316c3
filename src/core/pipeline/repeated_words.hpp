// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include <sks_detector/codebook.hpp>

#include "core/descriptors/quantizer.hpp"

namespace sks {

/// Codewords of views of a mesh, to tell which of a further view say nothing new: the same place of the object,
/// described so much alike that a sensor tells them apart by its noise alone. The views of a model come one after the
/// other: with those of the next one it forgets them.
class RepeatedWords {
public:
  /// @param same_place how near two words of one place are at most [m]
  explicit RepeatedWords(float same_place) : same_place_(same_place) {}

  /// What follows is of this model. @param name object and model frame, by any text
  void beginView(const std::string& name);

  /// Whether an earlier word of the model is near in place, rotation and descriptor.
  /// @param rows those of the words that were added
  bool repeats(const Codeword& word, const float* bins, const Quantizer& rows);

  /// @param index of the word, and of its row
  void add(const Codeword& word, std::uint32_t index);

private:
  using Cell = std::tuple<int, int, int>;
  struct Place {
    Codeword word;
    std::uint32_t index;
  };

  Cell cellOf(const Codeword& word) const;

  float same_place_;
  std::string model_;
  std::map<Cell, std::vector<Place>> cells_;
  std::vector<float> buffer_;
};

}  // namespace sks
