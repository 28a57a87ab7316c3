// SPDX-License-Identifier: BSD-3-Clause
#include "ros/camera/openni2_images.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace sks_detector {
namespace {

const char* row(const openni::VideoFrameRef& frame, int y) {
  return static_cast<const char*>(frame.getData()) + std::ptrdiff_t(y) * frame.getStrideInBytes();
}

/// Copies row by row, as a driver may leave gaps between them.
template <typename Pixel>
std::vector<Pixel> copyPixels(const openni::VideoFrameRef& frame, bool mirrored) {
  const std::size_t width = std::size_t(frame.getWidth());
  std::vector<Pixel> pixels(width * std::size_t(frame.getHeight()));
  for (int y = 0; y < frame.getHeight(); ++y) {
    Pixel* target = pixels.data() + std::size_t(y) * width;
    std::memcpy(target, row(frame, y), width * sizeof(Pixel));
    if (mirrored) std::reverse(target, target + width);
  }
  return pixels;
}

}  // namespace

DepthImage depthImage(const openni::VideoFrameRef& frame, bool mirrored) {
  DepthImage image;
  image.width = frame.getWidth();
  image.height = frame.getHeight();
  image.time = frame.getTimestamp();
  image.pixels = copyPixels<std::uint16_t>(frame, mirrored);
  if (frame.getVideoMode().getPixelFormat() == openni::PIXEL_FORMAT_DEPTH_100_UM) {
    for (std::uint16_t& depth : image.pixels) depth = std::uint16_t((depth + 5) / 10);
  }
  return image;
}

ColorImage colorImage(const openni::VideoFrameRef& frame, bool mirrored) {
  ColorImage image;
  image.width = frame.getWidth();
  image.height = frame.getHeight();
  image.time = frame.getTimestamp();
  const auto pixels = copyPixels<openni::RGB888Pixel>(frame, mirrored);
  image.pixels.resize(pixels.size() * sizeof(openni::RGB888Pixel));
  std::memcpy(image.pixels.data(), pixels.data(), image.pixels.size());
  return image;
}

}  // namespace sks_detector
