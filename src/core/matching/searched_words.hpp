// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include <sks_detector/stages/descriptors.hpp>
#include <sks_detector/stages/quantized_descriptors.hpp>

namespace sks {

/// Histograms among which the nearest one is looked for: floats, or rounded ones, as codebooks hold them.
class SearchedWords {
public:
  SearchedWords() = default;
  // Both are words as they stand, so they convert.
  // cppcheck-suppress noExplicitConstructor
  SearchedWords(DescriptorMatrix words) : floats_(std::move(words)) {}  // NOLINT(google-explicit-constructor)
  // cppcheck-suppress noExplicitConstructor
  SearchedWords(QuantizedDescriptors words) : rounded_(std::move(words)) {}  // NOLINT(google-explicit-constructor)

  std::size_t rows() const { return floats_.rows() + rounded_.rows(); }
  std::size_t cols() const { return floats_.cols() + rounded_.cols(); }

  /// The bins of a word: where they lie, or read to a buffer.
  const float* row(std::size_t word, std::vector<float>& buffer) const {
    if (rounded_.rows() == 0) return floats_.row(word);
    buffer.resize(cols());
    rounded_.read(word, buffer.data());
    return buffer.data();
  }

  /// Words are read from memory, one after the other in no order that the processor could foresee.
  void prefetch(std::size_t word) const {
    if (rounded_.rows() == 0) {
      prefetch(floats_.row(word), cols() * sizeof(float));
    } else {
      prefetch(rounded_.levels(word), cols());
    }
  }

  /// @throws Error(bad_data) naming word and bin for a value that is negative or not finite
  void checkHistograms() const;

private:
  static void prefetch(const void* from, std::size_t bytes) {
    constexpr std::size_t line = 64;
    for (std::size_t i = 0; i < bytes; i += line) __builtin_prefetch(static_cast<const char*>(from) + i);
  }

  DescriptorMatrix floats_;
  QuantizedDescriptors rounded_;
};

}  // namespace sks
