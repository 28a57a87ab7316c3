// SPDX-License-Identifier: BSD-3-Clause
// TGA. It has no signature: its header must be one that makes sense.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "io/image_codec.hpp"
#include "io/little_endian.hpp"

namespace sks {
namespace {

constexpr std::size_t tga_header_bytes = 18;
constexpr unsigned tga_palette = 1, tga_color = 2, tga_gray = 3;  // kinds of pixels

/// What the header says.
struct TgaHeader {
  explicit TgaHeader(const LittleEndian& bytes)
      : has_palette(bytes.u8(1)),
        kind(bytes.u8(2) & ~8u),
        packed((bytes.u8(2) & 8) != 0),
        palette_first(bytes.u16(3)),
        palette_size(bytes.u16(5)),
        palette_bits(bytes.u8(7)),
        width(bytes.u16(12)),
        height(bytes.u16(14)),
        bits(bytes.u8(16)),
        from_right((bytes.u8(17) & 0x10) != 0),
        from_top((bytes.u8(17) & 0x20) != 0),
        palette_begin(tga_header_bytes + bytes.u8(0)),
        pixel_begin(palette_begin + (has_palette == 1 ? palette_size * ((palette_bits + 7) / 8) : 0)) {}

  bool makesSense() const {
    const auto colorful = [](unsigned b) { return b == 15 || b == 16 || b == 24 || b == 32; };
    if (has_palette > 1 || width == 0 || height == 0) return false;
    if (kind == tga_palette) return has_palette == 1 && palette_size > 0 && colorful(palette_bits) && bits == 8;
    return kind == tga_color ? colorful(bits) : kind == tga_gray && (bits == 8 || bits == 16);
  }

  unsigned has_palette, kind;
  bool packed;
  unsigned palette_first, palette_size, palette_bits, width, height, bits;
  bool from_right, from_top;
  std::size_t palette_begin, pixel_begin;
};

Rgb tgaColor(const LittleEndian& bytes, std::size_t at, unsigned bits) {
  if (bits >= 24) return {bytes.u8(at + 2), bytes.u8(at + 1), bytes.u8(at)};
  const unsigned value = bytes.u16(at);
  const auto byte = [](unsigned five) { return std::uint8_t((five * 255 + 15) / 31); };
  return {byte(value >> 10 & 31), byte(value >> 5 & 31), byte(value & 31)};
}

Rgb tgaPixel(const LittleEndian& bytes, std::size_t at, const TgaHeader& header) {
  if (header.kind == tga_gray) return {bytes.u8(at), bytes.u8(at), bytes.u8(at)};
  if (header.kind == tga_color) return tgaColor(bytes, at, header.bits);
  const unsigned index = bytes.u8(at);
  if (index < header.palette_first || index - header.palette_first >= header.palette_size) {
    throw CodecError("it is damaged: a colour is not in its palette");
  }
  const std::size_t entry = (header.palette_bits + 7) / 8;
  return tgaColor(bytes, header.palette_begin + (index - header.palette_first) * entry, header.palette_bits);
}

/// The pixels in the order of the file.
std::vector<Rgb> tgaPixels(const LittleEndian& bytes, const TgaHeader& header) {
  const std::size_t count = std::size_t(header.width) * header.height, step = (header.bits + 7) / 8;
  std::vector<Rgb> pixels;
  pixels.reserve(count);
  std::size_t at = header.pixel_begin;
  while (pixels.size() < count) {
    std::size_t run = count, repeats = 1;
    if (header.packed) {
      const unsigned packet = bytes.u8(at++);
      run = packet & 0x80 ? 1 : (packet & 0x7f) + 1;
      repeats = packet & 0x80 ? (packet & 0x7f) + 1 : 1;
    }
    for (; run > 0 && pixels.size() < count; --run, at += step) {
      pixels.insert(pixels.end(), std::min(repeats, count - pixels.size()), tgaPixel(bytes, at, header));
    }
  }
  return pixels;
}

}  // namespace

bool isTga(const std::string& bytes) {
  return bytes.size() > tga_header_bytes && TgaHeader(LittleEndian(bytes)).makesSense();
}

ColorImage decodeTga(const std::string& bytes) {
  const LittleEndian data(bytes);
  const TgaHeader header(data);
  checkImageSize(header.width, header.height, bytes.size());
  const std::vector<Rgb> pixels = tgaPixels(data, header);
  ColorImage image(int(header.width), int(header.height));
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const int row = int(i / header.width), column = int(i % header.width);
    image(header.from_top ? row : image.height - 1 - row, header.from_right ? image.width - 1 - column : column) =
        pixels[i];
  }
  return image;
}

}  // namespace sks
