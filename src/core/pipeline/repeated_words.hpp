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
/// described so much alike that a sensor tells them apart by its noise alone.
class RepeatedWords {
public:
  /// @param same_place how near two words of one place are at most [m]
  explicit RepeatedWords(float same_place) : same_place_(same_place) {}

  /// Whether an earlier word of the model is near in place, rotation and descriptor.
  /// @param model object and model frame, by any text @param rows those of the words that were added
  bool repeats(const std::string& model, const Codeword& word, const float* bins, const Quantizer& rows);

  /// @param index of the word, and of its row
  void add(const std::string& model, const Codeword& word, std::uint32_t index);

private:
  using Cell = std::tuple<int, int, int>;
  struct Place {
    Codeword word;
    std::uint32_t index;
  };

  Cell cellOf(const Codeword& word) const;

  float same_place_;
  std::map<std::string, std::map<Cell, std::vector<Place>>> models_;
  std::vector<float> buffer_;
};

}  // namespace sks
