// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include <sks_detector/stages/descriptors.hpp>

namespace sks {

/// Read-only matrix of histograms, one a row, in a quarter of the memory of floats; shares its storage. A bin is
/// level^2 * scale of its row, with levels of 8 bits: square roots are rounded, since chi squared is nearly uniform in
/// them. A SHOT descriptor moves by about 0.0001 of chi squared. Immutable and thread-safe.
class QuantizedDescriptors {
public:
  /// The largest bin that can be kept: sums over far larger ones would not be finite.
  static constexpr float largest_bin = 1e4f;
  /// The largest level; every row has it, unless all its bins are zero.
  static constexpr int largest_level = 255;

  QuantizedDescriptors() = default;
  /// Rounds. The same on every machine.
  /// @throws Error(bad_data) naming row and bin for a value that is negative, above largest_bin or not finite
  explicit QuantizedDescriptors(const DescriptorMatrix& values);
  /// Refers to `levels`, row by row, and `scales`, which stay alive as long as `owner`.
  QuantizedDescriptors(const std::uint8_t* levels, const float* scales, std::size_t rows, std::size_t cols,
                       std::shared_ptr<const void> owner);

  std::size_t rows() const { return rows_; }
  std::size_t cols() const { return cols_; }
  const std::uint8_t* levels(std::size_t row) const { return levels_ + row * cols_; }
  float scale(std::size_t row) const { return scales_[row]; }
  /// One for each row.
  const float* scales() const { return scales_; }

  /// Writes the `cols()` bins of a row.
  void read(std::size_t row, float* bins) const;
  /// All bins.
  DescriptorMatrix values() const;

private:
  const std::uint8_t* levels_ = nullptr;
  const float* scales_ = nullptr;
  std::size_t rows_ = 0;
  std::size_t cols_ = 0;
  std::shared_ptr<const void> owner_;
};

}  // namespace sks
