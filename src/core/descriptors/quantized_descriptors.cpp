// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/stages/quantized_descriptors.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <sks_detector/error.hpp>

#include "core/descriptors/quantizer.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/descriptors/quantized_descriptors.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sks {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Squares of levels are exact, so that all instruction sets give the same.
void readLevelsImpl(const std::uint8_t* levels, float scale, std::size_t size, float* bins) {
  const hn::ScalableTag<float> d;
  const hn::Rebind<std::int32_t, decltype(d)> di;
  const hn::Rebind<std::uint8_t, decltype(d)> d_levels;
  const auto scales = hn::Set(d, scale);
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= size; i += hn::Lanes(d)) {
    const auto level = hn::ConvertTo(d, hn::PromoteTo(di, hn::LoadU(d_levels, levels + i)));
    hn::StoreU(hn::Mul(hn::Mul(level, level), scales), d, bins + i);
  }
  for (; i < size; ++i) bins[i] = float(levels[i]) * float(levels[i]) * scale;
}

}  // namespace HWY_NAMESPACE
}  // namespace sks
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sks {

HWY_EXPORT(readLevelsImpl);

void Quantizer::add(const float* bins) {
  float largest = 0;
  for (std::size_t bin = 0; bin < cols_; ++bin) {
    if (!(bins[bin] >= 0 && bins[bin] <= QuantizedDescriptors::largest_bin)) {
      throw Error(ErrorCode::bad_data, "descriptor " + std::to_string(scales_.size()) + " is no histogram: bin " +
                                           std::to_string(bin) + " is " + std::to_string(bins[bin]));
    }
    largest = std::max(largest, bins[bin]);
  }
  constexpr float top = QuantizedDescriptors::largest_level;
  const float scale = largest / (top * top);
  std::uint8_t* levels = levels_.grow(cols_);
  *scales_.grow(1) = scale;
  for (std::size_t bin = 0; bin < cols_; ++bin) {
    levels[bin] = bins[bin] > 0 ? std::uint8_t(top * std::sqrt(bins[bin] / largest) + 0.5f) : 0;
  }
}

void Quantizer::add(const QuantizedDescriptors& rows, std::size_t row) {
  std::copy_n(rows.levels(row), cols_, levels_.grow(cols_));
  *scales_.grow(1) = rows.scale(row);
}

void Quantizer::read(std::size_t row, float* bins) const {
  HWY_DYNAMIC_DISPATCH(readLevelsImpl)(levels_.data() + row * cols_, scales_.data()[row], cols_, bins);
}

QuantizedDescriptors Quantizer::release() {
  const std::size_t rows = scales_.size();
  const auto owner =
      std::make_shared<const std::pair<std::shared_ptr<const std::uint8_t>, std::shared_ptr<const float>>>(
          levels_.release(), scales_.release());
  return QuantizedDescriptors(owner->first.get(), owner->second.get(), rows, cols_, owner);
}

QuantizedDescriptors::QuantizedDescriptors(const DescriptorMatrix& values) {
  Quantizer quantizer(values.cols());
  for (std::size_t row = 0; row < values.rows(); ++row) quantizer.add(values.row(row));
  *this = quantizer.release();
}

QuantizedDescriptors::QuantizedDescriptors(const std::uint8_t* levels, const float* scales, std::size_t rows,
                                           std::size_t cols, std::shared_ptr<const void> owner)
    : levels_(levels), scales_(scales), rows_(rows), cols_(cols), owner_(std::move(owner)) {}

void QuantizedDescriptors::read(std::size_t row, float* bins) const {
  HWY_DYNAMIC_DISPATCH(readLevelsImpl)(levels(row), scale(row), cols_, bins);
}

DescriptorMatrix QuantizedDescriptors::values() const {
  if (cols_ == 0) return {};
  std::vector<float> bins(rows_ * cols_);
  for (std::size_t row = 0; row < rows_; ++row) read(row, &bins[row * cols_]);
  return DescriptorMatrix(std::move(bins), cols_);
}

}  // namespace sks
#endif
