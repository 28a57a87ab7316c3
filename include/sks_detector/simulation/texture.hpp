// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <sks_detector/cloud.hpp>

namespace sks {

/// An image that covers a surface, with smaller copies of itself, so that a pixel of the camera that sees many texels
/// takes their mean.
class Texture {
public:
  Texture() = default;
  /// @param pixels width * height colours, rows from the top
  /// @throws Error(bad_data) if their number does not fit
  Texture(int width, int height, std::vector<Rgb> pixels);

  int width() const { return levels_.empty() ? 0 : levels_.front().width; }
  int height() const { return levels_.empty() ? 0 : levels_.front().height; }

  /// The colour at (u, v): u to the right, v upwards, both repeating outside of [0, 1]; bilinear. What is not
  /// finite counts as 0.
  /// @param footprint edge of the surface that is averaged, in texels
  Rgb at(float u, float v, float footprint = 1) const;

private:
  struct Level {
    int width, height;
    std::vector<Rgb> pixels;
  };
  static Level half(const Level& level);

  std::vector<Level> levels_;  // each half as wide and high as the one before
};

}  // namespace sks
