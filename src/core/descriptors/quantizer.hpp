// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>

#include <sks_detector/stages/quantized_descriptors.hpp>

namespace sks {

/// Numbers that grow in place: a vector would copy them from time to time, and hold them twice meanwhile. Large blocks
/// are moved by the kernel, page by page.
template <typename Number>
class GrowingValues {
public:
  std::size_t size() const { return size_; }

  const Number* data() const { return data_.get(); }

  /// @return where the new ones are to be written
  Number* grow(std::size_t count) {
    if (size_ + count > capacity_) reserve(std::max(size_ + count, capacity_ + capacity_ / 2));
    size_ += count;
    return data_.get() + size_ - count;
  }

  /// Leaves nothing here.
  std::shared_ptr<const Number> release() {
    if (size_ > 0) reserve(size_);
    size_ = capacity_ = 0;
    return std::shared_ptr<const Number>(data_.release(), std::free);
  }

private:
  void reserve(std::size_t capacity) {
    void* moved = std::realloc(data_.get(), capacity * sizeof(Number));
    if (moved == nullptr) throw std::bad_alloc();
    static_cast<void>(data_.release());  // realloc() has freed it
    data_.reset(static_cast<Number*>(moved));
    capacity_ = capacity;
  }

  struct Free {
    void operator()(Number* data) const { std::free(data); }
  };
  std::unique_ptr<Number, Free> data_;
  std::size_t size_ = 0, capacity_ = 0;
};

/// Collects rows of QuantizedDescriptors.
class Quantizer {
public:
  explicit Quantizer(std::size_t cols) : cols_(cols) {}

  /// Rounds `cols` bins. @throws Error(bad_data) as QuantizedDescriptors
  void add(const float* bins);
  /// Takes over a row as it is.
  void add(const QuantizedDescriptors& rows, std::size_t row);

  std::size_t cols() const { return cols_; }
  /// Writes the bins of a row, as they are rounded.
  void read(std::size_t row, float* bins) const;

  /// Leaves nothing here.
  QuantizedDescriptors release();

private:
  std::size_t cols_;
  GrowingValues<std::uint8_t> levels_;
  GrowingValues<float> scales_;
};

}  // namespace sks
