// SPDX-License-Identifier: BSD-3-Clause
// Random histograms, and what a plain loop says of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <sks_detector/stages/descriptors.hpp>
#include <sks_detector/stages/quantized_descriptors.hpp>

namespace sks::test {

using Rows = std::vector<std::vector<float>>;

inline float uniform(std::mt19937& random) {
  return float(random() >> 8) / float(1 << 24);
}

/// L2-normalised.
inline std::vector<float> histogram(std::mt19937& random, std::size_t size, double filled = 0.3) {
  std::vector<float> bins(size, 0.0f);
  double squares = 0;
  for (float& bin : bins) {
    if (uniform(random) < filled) bin = uniform(random) * uniform(random);
    squares += double(bin) * bin;
  }
  for (float& bin : bins) bin /= float(std::sqrt(std::max(squares, 1e-12)));
  return bins;
}

inline Rows histograms(std::size_t count, std::size_t size, std::uint32_t seed, double filled = 0.3) {
  std::mt19937 random(seed);
  Rows rows(count);
  for (auto& row : rows) row = histogram(random, size, filled);
  return rows;
}

inline DescriptorMatrix matrix(const Rows& rows, std::size_t cols) {
  std::vector<float> values;
  for (const auto& row : rows) values.insert(values.end(), row.begin(), row.end());
  return DescriptorMatrix(values, cols);
}

inline QuantizedDescriptors quantized(const Rows& rows, std::size_t cols) {
  return QuantizedDescriptors(matrix(rows, cols));
}

/// As a codebook keeps them.
inline Rows rounded(const Rows& rows) {
  const DescriptorMatrix values = quantized(rows, rows.front().size()).values();
  Rows result;
  for (std::size_t i = 0; i < values.rows(); ++i) result.emplace_back(values.row(i), values.row(i) + values.cols());
  return result;
}

inline double plainChiSquared(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] + b[i] > 0) sum += (double(a[i]) - b[i]) * (double(a[i]) - b[i]) / (double(a[i]) + b[i]);
  }
  return sum;
}

}  // namespace sks::test
