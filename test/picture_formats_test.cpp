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

constexpr int width = 5, height = 3;

/// Every pixel another colour, of which five bits of each channel survive.
Rgb colorAt(int row, int column) {
  return {std::uint8_t(255 * (row * 10 + 1) / 31), std::uint8_t(255 * (column * 5 + 2) / 31),
          std::uint8_t(255 * 7 / 31)};
}

std::string number(std::uint64_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += char(value >> (8 * i) & 255);
  return text;
}

class PictureFormats : public ::testing::Test {
protected:
  void expectPicture(const std::string& bytes, bool gray = false) const {
    test::writeFile(folder_.path("a.picture"), bytes);
    const ColorImage image = readColorImage(folder_.path("a.picture"));
    ASSERT_EQ(image.width, width);
    ASSERT_EQ(image.height, height);
    for (int row = 0; row < height; ++row) {
      for (int column = 0; column < width; ++column) {
        const Rgb right = colorAt(row, column), read = image(row, column);
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
    return number(std::uint64_t((c.r * 31 + 127) / 255) << 10 | std::uint64_t((c.g * 31 + 127) / 255) << 5 |
                      std::uint64_t((c.b * 31 + 127) / 255),
                  2);
  std::string text = {char(c.b), char(c.g), char(c.r)};
  return bits == 32 ? text + '\x7f' : text;
}

std::string palette(int entry) {
  std::string text;
  for (int i = 0; i < width * height; ++i) {
    const Rgb c = colorAt(i / width, i % width);
    text += std::string{char(c.b), char(c.g), char(c.r)} + (entry == 4 ? std::string(1, '\0') : "");
  }
  return text;
}

/// @param header_size of the information, 12 for that of OS/2
std::string bmp(int bits, bool from_top, int header_size = 40) {
  const int used = bits <= 8 ? width * height : 0;
  const std::string colors = used > 0 ? palette(header_size == 12 ? 3 : 4) : "";
  std::string text = "BM" + number(0, 8) + number(std::uint64_t(14 + header_size) + colors.size(), 4);
  text += number(std::uint64_t(header_size), 4);
  const int size_bytes = header_size == 12 ? 2 : 4;
  text += number(width, size_bytes) + number(std::uint64_t(from_top ? -height : height), size_bytes) + number(1, 2) +
          number(std::uint64_t(bits), 2);
  if (header_size > 12) text += number(0, 16) + number(std::uint64_t(used), 4) + number(0, 4);
  text.resize(std::size_t(14 + header_size), '\0');
  text += colors;
  for (int k = 0; k < height; ++k) {
    const int row = from_top ? k : height - 1 - k;
    std::string line;
    for (int column = 0; column < width; ++column) {
      const int index = row * width + column;
      if (bits == 8) line += char(index);
      if (bits == 4 && column % 2 == 0) line += char(index << 4 | (column + 1 < width ? index + 1 : 0));
      if (bits >= 16) line += bytesOf(colorAt(row, column), bits);
    }
    line.resize((line.size() + 3) / 4 * 4, '\0');
    text += line;
  }
  return text;
}

std::string tga(int kind, int bits, bool packed, bool from_top, bool from_right) {
  std::string text = number(3, 1) + number(kind == 1 ? 1 : 0, 1) + number(std::uint64_t(kind + (packed ? 8 : 0)), 1);
  text += number(0, 2) + number(kind == 1 ? width * height : 0, 2) + number(kind == 1 ? 24 : 0, 1) + number(0, 4);
  text += number(width, 2) + number(height, 2) + number(std::uint64_t(bits), 1);
  text += number((from_top ? 0x20 : 0) | (from_right ? 0x10 : 0), 1) + "id!";
  if (kind == 1) text += palette(3);
  for (int k = 0; k < height; ++k) {
    const int row = from_top ? k : height - 1 - k;
    if (packed) text += number(1, 1);  // two pixels as they are, then runs of one
    for (int c = 0; c < width; ++c) {
      const int column = from_right ? width - 1 - c : c;
      if (packed && c >= 2) text += number(0x80, 1);
      if (kind == 1) text += char(row * width + column);
      if (kind == 2) text += bytesOf(colorAt(row, column), bits);
      if (kind == 3) text += char(colorAt(row, column).g);
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
  std::string text =
      number(0, 2) + number(10, 1) + number(0, 9) + number(100, 2) + number(2, 2) + number(24, 1) + number(0, 1);
  text += number(0x80 | 127, 1) + std::string("\x10\x20\x30") + number(0x80 | 71, 1) + std::string("\x01\x02\x03");
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
  huge_bmp.replace(18, 8, number(100000, 4) + number(100000, 4));
  huge_tga.replace(12, 4, number(65535, 2) + number(65535, 2));
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
