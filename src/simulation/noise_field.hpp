// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace sks {

/// Random numbers for the pixels of an image, each standard normal, those of neighbours alike.
struct NoiseField {
  int width = 0, height = 0;  ///< [px]
  /// Standard deviation of the Gaussian kernel that makes them alike; 0: independent. Pixels k apart correlate by
  /// exp(-k^2 / (4 sigma^2)) [px]
  double sigma_x = 0, sigma_y = 0;
  std::uint64_t seed = 1, frame = 0;
  std::uint64_t stream = 0;  ///< tells apart the fields of one picture

  /// Row-major; same members, same numbers, for any number of threads.
  std::vector<float> values(int threads) const;
};

}  // namespace sks
