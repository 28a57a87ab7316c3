// SPDX-License-Identifier: BSD-3-Clause
// BMP and TGA, as textures of meshes come in them.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.hpp"
#include "io/image_file.hpp"
#include "temporary_folder.hpp"

namespace sks {
namespace {

using ::testing::HasSubstr;

constexpr int picture_width = 5, picture_height = 3;

/// Every pixel another colour, of which five bits of each channel survive.
Rgb pixelColor(int row, int column) {
  return {std::uint8_t(255 * (row * 10 + 1) / 31), std::uint8_t(255 * (column * 5 + 2) / 31),
          std::uint8_t(255 * 7 / 31)};
}

std::string littleEndian(std::uint64_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += char(value >> (8 * i) & 255);
  return text;
}

class PictureFormats : public ::testing::Test {
protected:
  void expectPicture(const std::string& bytes, bool gray = false) const {
    test::writeFile(folder_.path("a.picture"), bytes);
    const ColorImage image = readColorImage(folder_.path("a.picture"));
    ASSERT_EQ(image.width, picture_width);
    ASSERT_EQ(image.height, picture_height);
    for (int row = 0; row < picture_height; ++row) {
      for (int column = 0; column < picture_width; ++column) {
        const Rgb right = pixelColor(row, column), read = image(row, column);
        EXPECT_NEAR(read.r, gray ? right.g : right.r, 1) << row << " " << column;
        EXPECT_NEAR(read.g, right.g, 1);
        EXPECT_NEAR(read.b, gray ? right.g : right.b, 1);
      }
    }
  }
  void expectCutOff(const std::string& bytes, std::size_t lost) const {
    test::writeFile(folder_.path("a.picture"), bytes.substr(0, bytes.size() - lost));
    EXPECT_THAT(test::errorOf(ErrorCode::bad_file, [&] { readColorImage(folder_.path("a.picture")); }),
                HasSubstr("it is cut off"));
  }

  test::TemporaryFolder folder_;
};

std::string bytesOf(const Rgb& c, int bits) {
  if (bits == 16)
    return littleEndian(std::uint64_t((c.r * 31 + 127) / 255) << 10 | std::uint64_t((c.g * 31 + 127) / 255) << 5 |
                            std::uint64_t((c.b * 31 + 127) / 255),
                        2);
  std::string text = {char(c.b), char(c.g), char(c.r)};
  return bits == 32 ? text + '\x7f' : text;
}

std::string paletteBytes(int entry) {
  std::string text;
  for (int i = 0; i < picture_width * picture_height; ++i) {
    const Rgb c = pixelColor(i / picture_width, i % picture_width);
    text += std::string{char(c.b), char(c.g), char(c.r)} + (entry == 4 ? std::string(1, '\0') : "");
  }
  return text;
}

/// @param header_size of the information, 12 for that of OS/2
std::string bmp(int bits, bool from_top, int header_size = 40) {
  const int used = bits <= 8 ? picture_width * picture_height : 0;
  const std::string colors = used > 0 ? paletteBytes(header_size == 12 ? 3 : 4) : "";
  std::string text = "BM" + littleEndian(0, 8) + littleEndian(std::uint64_t(14 + header_size) + colors.size(), 4);
  text += littleEndian(std::uint64_t(header_size), 4);
  const int size_bytes = header_size == 12 ? 2 : 4;
  text += littleEndian(picture_width, size_bytes) +
          littleEndian(std::uint64_t(from_top ? -picture_height : picture_height), size_bytes) + littleEndian(1, 2) +
          littleEndian(std::uint64_t(bits), 2);
  if (header_size > 12) text += littleEndian(0, 16) + littleEndian(std::uint64_t(used), 4) + littleEndian(0, 4);
  text.resize(std::size_t(14 + header_size), '\0');
  text += colors;
  for (int k = 0; k < picture_height; ++k) {
    const int row = from_top ? k : picture_height - 1 - k;
    std::string line;
    for (int column = 0; column < picture_width; ++column) {
      const int index = row * picture_width + column;
      if (bits == 8) line += char(index);
      if (bits == 4 && column % 2 == 0) line += char(index << 4 | (column + 1 < picture_width ? index + 1 : 0));
      if (bits >= 16) line += bytesOf(pixelColor(row, column), bits);
    }
    line.resize((line.size() + 3) / 4 * 4, '\0');
    text += line;
  }
  return text;
}

std::string tga(int kind, int bits, bool packed, bool from_top, bool from_right) {
  std::string text =
      littleEndian(3, 1) + littleEndian(kind == 1 ? 1 : 0, 1) + littleEndian(std::uint64_t(kind + (packed ? 8 : 0)), 1);
  text += littleEndian(0, 2) + littleEndian(kind == 1 ? picture_width * picture_height : 0, 2) +
          littleEndian(kind == 1 ? 24 : 0, 1) + littleEndian(0, 4);
  text += littleEndian(picture_width, 2) + littleEndian(picture_height, 2) + littleEndian(std::uint64_t(bits), 1);
  text += littleEndian((from_top ? 0x20 : 0) | (from_right ? 0x10 : 0), 1) + "id!";
  if (kind == 1) text += paletteBytes(3);
  for (int k = 0; k < picture_height; ++k) {
    const int row = from_top ? k : picture_height - 1 - k;
    if (packed) text += littleEndian(1, 1);  // two pixels as they are, then runs of one
    for (int c = 0; c < picture_width; ++c) {
      const int column = from_right ? picture_width - 1 - c : c;
      if (packed && c >= 2) text += littleEndian(0x80, 1);
      if (kind == 1) text += char(row * picture_width + column);
      if (kind == 2) text += bytesOf(pixelColor(row, column), bits);
      if (kind == 3) text += char(pixelColor(row, column).g);
    }
  }
  return text;
}

TEST_F(PictureFormats, BmpOfAllDepthsIsRead) {
  for (const bool from_top : {false, true}) {
    for (const int bits : {4, 8, 16, 24, 32}) {
      for (const int header : {40, 108, 124}) {
        SCOPED_TRACE(std::to_string(bits) + " bits, header " + std::to_string(header));
        expectPicture(bmp(bits, from_top, header));
      }
    }
  }
  expectPicture(bmp(24, false, 12));
  expectPicture(bmp(24, true) + "something behind it");
}

TEST_F(PictureFormats, TgaOfAllKindsIsRead) {
  for (const bool packed : {false, true}) {
    for (const bool from_top : {false, true}) {
      for (const bool from_right : {false, true}) {
        SCOPED_TRACE(std::to_string(packed) + std::to_string(from_top) + std::to_string(from_right));
        for (const int bits : {16, 24, 32}) expectPicture(tga(2, bits, packed, from_top, from_right));
        expectPicture(tga(1, 8, packed, from_top, from_right));
        expectPicture(tga(3, 8, packed, from_top, from_right), true);
      }
    }
  }
}

TEST_F(PictureFormats, RunsRepeatAPixel) {
  std::string text = littleEndian(0, 2) + littleEndian(10, 1) + littleEndian(0, 9) + littleEndian(100, 2) +
                     littleEndian(2, 2) + littleEndian(24, 1) + littleEndian(0, 1);
  text += littleEndian(0x80 | 127, 1) + std::string("\x10\x20\x30") + littleEndian(0x80 | 71, 1) +
          std::string("\x01\x02\x03");
  test::writeFile(folder_.path("a.tga"), text);
  const ColorImage image = readColorImage(folder_.path("a.tga"));
  ASSERT_EQ(image.pixels.size(), 200u);
  EXPECT_EQ(image(1, 0).r, 0x30);
  EXPECT_EQ(image(0, 27).b, 0x10);
  EXPECT_EQ(image(0, 28).b, 0x01);
}

TEST_F(PictureFormats, WhatIsCutOffIsRefused) {
  for (const int bits : {8, 16, 24}) {
    for (const std::size_t lost : {std::size_t(1), std::size_t(20)}) expectCutOff(bmp(bits, false), lost);
  }
  for (const bool packed : {false, true}) {
    for (const std::size_t lost : {std::size_t(1), std::size_t(9)}) expectCutOff(tga(2, 24, packed, true, false), lost);
  }
}

TEST_F(PictureFormats, HugeOnesAreRefusedBeforeMemoryIsTaken) {
  std::string huge_bmp = bmp(24, false), huge_tga = tga(2, 24, true, true, false);
  huge_bmp.replace(18, 8, littleEndian(100000, 4) + littleEndian(100000, 4));
  huge_tga.replace(12, 4, littleEndian(65535, 2) + littleEndian(65535, 2));
  for (const std::string& bytes : {huge_bmp, huge_tga}) {
    test::writeFile(folder_.path("a.picture"), bytes);
    EXPECT_THAT(test::errorOf(ErrorCode::bad_file, [&] { readColorImage(folder_.path("a.picture")); }),
                HasSubstr("pixels, which is more than can be read (8192 x 8192); make it smaller"));
  }
}

TEST_F(PictureFormats, RunLengthsInBmpAreRefusedWithTheRemedy) {
  std::string bytes = bmp(8, false);
  bytes[30] = 1;
  test::writeFile(folder_.path("a.bmp"), bytes);
  EXPECT_THAT(test::errorOf(ErrorCode::bad_file, [&] { readColorImage(folder_.path("a.bmp")); }),
              HasSubstr("it is a compressed BMP, which is not read; save it as PNG"));
}

}  // namespace
}  // namespace sks
