// SPDX-License-Identifier: BSD-3-Clause
// Pictures, as readColorImage() and readDepthImage() take them. The decoders are those of libpng and libjpeg.
#include "io/image_file.hpp"

#include "memory_file.hpp"
#include "refused.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const sks::fuzz::MemoryFile file(data, size);
  const auto whole = [](const auto& image) {
    sks::fuzz::require(image.width > 0 && image.height > 0 &&
                           image.pixels.size() == std::size_t(image.width) * std::size_t(image.height),
                       "a picture has as many pixels as its size says");
  };
  sks::fuzz::refused([&] { whole(sks::readColorImage(file.path())); });
  sks::fuzz::refused([&] { whole(sks::readDepthImage(file.path())); });
  return 0;
}
