// SPDX-License-Identifier: BSD-3-Clause
// What image_file is made of: pictures as the bytes of files.
#pragma once

#include <stdexcept>
#include <string>

#include "io/image_file.hpp"

namespace sks {

/// What is wrong with the bytes, without the name of their file.
struct CodecError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// @param bytes of the file: a small one cannot hold a huge picture, for which no memory shall be taken
/// @throws CodecError unless the size is one that may be read
void checkImageSize(std::uint64_t width, std::uint64_t height, std::size_t bytes);

/// @throws CodecError
ColorImage decodeColorPng(const std::string& bytes);
/// @throws CodecError, also where it is not one channel of 16 bits
DepthImage decodeDepthPng(const std::string& bytes);
/// @throws CodecError
ColorImage decodeJpeg(const std::string& bytes);
/// @throws CodecError, also where it is compressed
ColorImage decodeBmp(const std::string& bytes);
/// Whether it can be a TGA file, which nothing but the sense of its header tells.
bool isTga(const std::string& bytes);
/// @throws CodecError
ColorImage decodeTga(const std::string& bytes);

}  // namespace sks
