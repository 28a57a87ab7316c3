// SPDX-License-Identifier: BSD-3-Clause
// BMP without compression. No library of the distribution reads it that says where a file is cut off.
#include <cstdint>

#include "io/image_codec.hpp"
#include "io/little_endian.hpp"

namespace sks {
namespace {

constexpr std::size_t bmp_file_header = 14;  // [bytes]

/// One channel of a pixel in 16 or 32 bits.
struct Mask {
  std::uint32_t bits = 0;

  std::uint8_t of(std::uint32_t pixel) const {
    if (bits == 0) return 0;
    std::uint32_t mask = bits;
    pixel &= bits;
    for (; (mask & 1) == 0; mask >>= 1) pixel >>= 1;
    return std::uint8_t((std::uint64_t(pixel) * 255 + mask / 2) / mask);
  }
};

class BmpReader {
public:
  explicit BmpReader(const std::string& bytes) : bytes_(bytes) {}

  ColorImage read() {
    readHeader();
    const std::size_t row_bytes = (std::size_t(width_) * bits_ + 31) / 32 * 4;
    const std::size_t begin = bytes_.u32(10);
    if (bytes_.size() < begin || (bytes_.size() - begin) / row_bytes < std::size_t(height_)) {
      throw CodecError("it is cut off");
    }
    ColorImage image(width_, height_);
    for (int row = 0; row < height_; ++row) {
      const int from_begin = top_down_ ? row : height_ - 1 - row;
      const std::size_t place = begin + std::size_t(from_begin) * row_bytes;
      for (int column = 0; column < width_; ++column) image(row, column) = pixel(place, std::size_t(column));
    }
    return image;
  }

private:
  void readHeader();
  Rgb pixel(std::size_t row, std::size_t column) const;

  LittleEndian bytes_;
  int width_ = 0, height_ = 0;
  unsigned bits_ = 0;  // of a pixel
  bool top_down_ = false;
  Mask red_, green_, blue_;
  std::size_t palette_ = 0, palette_entry_ = 4, palette_size_ = 0;
};

void BmpReader::readHeader() {
  const std::uint32_t header = bytes_.u32(bmp_file_header);
  const bool old = header == 12;  // of OS/2
  if (!old && (header < 40 || header > 124)) throw CodecError("it is a BMP of an unknown kind");
  const std::int32_t width = std::int32_t(old ? bytes_.u16(18) : bytes_.u32(18));
  const std::int64_t height = std::int32_t(old ? bytes_.u16(20) : bytes_.u32(22));  // negative: from the top
  bits_ = bytes_.u16(old ? 24 : 28);
  const std::uint32_t compression = old ? 0 : bytes_.u32(30);
  if (compression != 0 && compression != 3 && compression != 6) {
    throw CodecError("it is a compressed BMP, which is not read; save it as PNG");
  }
  if (width < 1 || height == 0) throw CodecError("it has no pixels");
  top_down_ = height < 0;
  checkImageSize(std::uint64_t(width), std::uint64_t(top_down_ ? -height : height), bytes_.size());
  width_ = width;
  height_ = int(top_down_ ? -height : height);
  if (bits_ == 1 || bits_ == 4 || bits_ == 8) {
    palette_ = bmp_file_header + header;
    palette_entry_ = old ? 3 : 4;
    const std::uint32_t used = old ? 0 : bytes_.u32(46);
    palette_size_ = used == 0 || used > (1u << bits_) ? 1u << bits_ : used;
  } else if (bits_ == 16 || bits_ == 32) {
    const bool masks = compression != 0;
    red_.bits = masks ? bytes_.u32(54) : bits_ == 16 ? 0x7c00 : 0xff0000;
    green_.bits = masks ? bytes_.u32(58) : bits_ == 16 ? 0x3e0 : 0xff00;
    blue_.bits = masks ? bytes_.u32(62) : bits_ == 16 ? 0x1f : 0xff;
  } else if (bits_ != 24) {
    throw CodecError("it is a BMP of an unknown kind");
  }
}

Rgb BmpReader::pixel(std::size_t row, std::size_t column) const {
  if (bits_ == 24) {
    const std::size_t at = row + 3 * column;
    return {bytes_.u8(at + 2), bytes_.u8(at + 1), bytes_.u8(at)};
  }
  if (bits_ >= 16) {
    const std::uint32_t value = bits_ == 16 ? bytes_.u16(row + 2 * column) : bytes_.u32(row + 4 * column);
    return {red_.of(value), green_.of(value), blue_.of(value)};
  }
  const std::size_t bit = column * bits_;
  const unsigned index = (bytes_.u8(row + bit / 8) >> (8 - bits_ - bit % 8)) & ((1u << bits_) - 1);
  if (index >= palette_size_) throw CodecError("it is damaged: a colour is not in its palette");
  const std::size_t at = palette_ + index * palette_entry_;
  return {bytes_.u8(at + 2), bytes_.u8(at + 1), bytes_.u8(at)};
}

}  // namespace

ColorImage decodeBmp(const std::string& bytes) {
  return BmpReader(bytes).read();
}

}  // namespace sks
