// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <sks_detector/cloud.hpp>

namespace sks {

/// Pixels row by row from the top.
template <typename Pixel>
struct Image {
  Image() = default;
  Image(int image_width, int image_height, Pixel value = {})
      : width(image_width), height(image_height), pixels(std::size_t(width) * std::size_t(height), value) {}

  Pixel& operator()(int row, int column) { return pixels[std::size_t(row) * std::size_t(width) + std::size_t(column)]; }
  const Pixel& operator()(int row, int column) const {
    return pixels[std::size_t(row) * std::size_t(width) + std::size_t(column)];
  }

  int width = 0, height = 0;
  std::vector<Pixel> pixels;
};
using ColorImage = Image<Rgb>;
using DepthImage = Image<std::uint16_t>;

/// Most pixels of a picture that is read: 8192 x 8192, which take 200 MB. A file of some kilobytes can hold as many.
constexpr std::uint64_t max_image_pixels = std::uint64_t(1) << 26;

/// Reads a PNG or JPEG of any kind, a BMP without compression or a TGA as 8-bit RGB, without its alpha channel. What it
/// is, its content says.
/// @throws Error(bad_file) naming the path and what is wrong, also where it has too many pixels
ColorImage readColorImage(const std::string& path);

/// The same from the bytes of a file. @throws Error(bad_data) saying what is wrong
ColorImage decodeColorImage(const std::string& bytes);

/// Reads a PNG of one channel with 16 bits. @throws Error(bad_file)
DepthImage readDepthImage(const std::string& path);

/// The bytes of a PNG file.
std::string encodePng(const ColorImage& image);
std::string encodePng(const DepthImage& image);
/// The bytes of a JPEG file.
std::string encodeJpeg(const ColorImage& image);

}  // namespace sks
