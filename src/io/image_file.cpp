// SPDX-License-Identifier: BSD-3-Clause
#include "io/image_file.hpp"

#include <sks_detector/error.hpp>

#include "io/file.hpp"
#include "io/image_codec.hpp"

namespace sks {
namespace {

constexpr std::size_t max_file_bytes = std::size_t(256) << 20;

bool startsWith(const std::string& bytes, const std::string& signature) {
  return bytes.compare(0, signature.size(), signature) == 0;
}

/// A remedy for what some data sets hold.
void refuseTiff(const std::string& bytes) {
  if (startsWith(bytes, std::string("II*\0", 4)) || startsWith(bytes, std::string("MM\0*", 4))) {
    throw CodecError("it is a TIFF file: convert it to PNG, for example by `mogrify -format png *.tif`");
  }
}

ColorImage decodeAny(const std::string& bytes) {
  if (startsWith(bytes, "\x89PNG\r\n\x1a\n")) return decodeColorPng(bytes);
  if (startsWith(bytes, "\xff\xd8\xff")) return decodeJpeg(bytes);
  if (startsWith(bytes, "BM")) return decodeBmp(bytes);
  if (isTga(bytes)) return decodeTga(bytes);
  refuseTiff(bytes);
  throw CodecError("it is no PNG, JPEG, BMP or TGA file; save it as PNG");
}

/// What `decoder` makes of a file's bytes.
template <typename Decoder>
auto readWith(const std::string& path, Decoder decoder) {
  const std::string bytes = readTextFile(path, max_file_bytes);
  try {
    return decoder(bytes);
  } catch (const CodecError& error) {
    throw Error(ErrorCode::bad_file, "cannot read '" + path + "': " + error.what());
  }
}

}  // namespace

ColorImage readColorImage(const std::string& path) {
  return readWith(path, decodeAny);
}

ColorImage decodeColorImage(const std::string& bytes) {
  try {
    return decodeAny(bytes);
  } catch (const CodecError& error) {
    throw Error(ErrorCode::bad_data, error.what());
  }
}

DepthImage readDepthImage(const std::string& path) {
  return readWith(path, [](const std::string& bytes) {
    if (startsWith(bytes, "\x89PNG\r\n\x1a\n")) return decodeDepthPng(bytes);
    refuseTiff(bytes);
    throw CodecError("it is no PNG file");
  });
}

}  // namespace sks
