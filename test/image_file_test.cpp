// SPDX-License-Identifier: BSD-3-Clause
#include "io/image_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.hpp"
#include "temporary_folder.hpp"

namespace sks {
namespace {

using ::testing::HasSubstr;

class ImageFile : public ::testing::Test {
protected:
  std::string write(const std::string& name, const std::string& content) const {
    test::writeFile(folder_.path(name), content);
    return folder_.path(name);
  }
  std::string refusal(const std::string& path) const {
    return test::errorOf(ErrorCode::bad_file, [&] { readColorImage(path); });
  }

  test::TemporaryFolder folder_;
};

ColorImage gradient(int width, int height) {
  ColorImage image(width, height);
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      image(row, column) = {std::uint8_t(3 * column), std::uint8_t(5 * row), std::uint8_t(column + row)};
    }
  }
  return image;
}

int difference(const Rgb& a, const Rgb& b) {
  return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b);
}

std::string text(const std::vector<int>& bytes) {
  return {bytes.begin(), bytes.end()};
}

/// One pixel each, of other programs.
const std::string gray_with_alpha =
    text({0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00,
          0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x04, 0x00, 0x00, 0x00, 0xb5, 0x1c, 0x0c, 0x02, 0x00,
          0x00, 0x00, 0x0b, 0x49, 0x44, 0x41, 0x54, 0x78, 0xda, 0x63, 0x64, 0x60, 0x00, 0x00, 0x00, 0x06, 0x00,
          0x02, 0x30, 0x81, 0xd0, 0x2f, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82});

TEST_F(ImageFile, PngGivesBackWhatWasWritten) {
  const ColorImage image = gradient(7, 5);
  const ColorImage read = readColorImage(write("a.png", encodePng(image)));
  ASSERT_EQ(read.width, 7);
  ASSERT_EQ(read.height, 5);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) EXPECT_EQ(difference(image.pixels[i], read.pixels[i]), 0) << i;
}

TEST_F(ImageFile, DepthKeepsItsSixteenBits) {
  DepthImage depth(3, 2);
  depth.pixels = {0, 1, 256, 8000, 65535, 4660};
  const std::string path = write("a.png", encodePng(depth));
  EXPECT_EQ(readDepthImage(path).pixels, depth.pixels);
  EXPECT_EQ(readDepthImage(path).width, 3);
  const ColorImage gray = readColorImage(path);  // the upper bytes
  EXPECT_EQ(difference(gray(1, 0), {31, 31, 31}), 0);
  EXPECT_EQ(difference(gray(1, 1), {255, 255, 255}), 0);
}

TEST_F(ImageFile, JpegIsNearlyWhatWasWritten) {
  ColorImage image(32, 16, {200, 40, 90});
  const ColorImage read = readColorImage(write("a.jpg", encodeJpeg(image)));
  ASSERT_EQ(read.width, 32);
  ASSERT_EQ(read.height, 16);
  for (const Rgb& pixel : read.pixels) EXPECT_LT(difference(pixel, {200, 40, 90}), 8);
}

TEST_F(ImageFile, TheContentSaysWhatItIs) {
  EXPECT_EQ(readColorImage(write("a.jpg", encodePng(gradient(4, 3)))).width, 4);
  EXPECT_EQ(readColorImage(write("noending", encodeJpeg(gradient(4, 3)))).height, 3);
}

TEST_F(ImageFile, GrayIsColourAndAlphaIsDropped) {
  const ColorImage read = readColorImage(write("a.png", gray_with_alpha));
  ASSERT_EQ(read.pixels.size(), 1u);
  EXPECT_EQ(read.pixels[0].r, read.pixels[0].b);
  EXPECT_EQ(read.pixels[0].r, read.pixels[0].g);
}

TEST_F(ImageFile, RefusesWhatIsNoPicture) {
  EXPECT_THAT(refusal(folder_.path("gone.png")), HasSubstr("gone.png': No such file"));
  EXPECT_THAT(refusal(folder_.path()), HasSubstr("it is a folder"));
  EXPECT_THAT(refusal(write("empty.png", "")), HasSubstr("it is no PNG, JPEG, BMP or TGA file"));
  EXPECT_THAT(refusal(write("text.png", "hello")), HasSubstr("text.png': it is no PNG, JPEG, BMP or TGA file"));
  EXPECT_THAT(test::errorOf(ErrorCode::bad_file, [&] { readDepthImage(write("d.png", encodeJpeg(gradient(2, 2)))); }),
              HasSubstr("it is no PNG file"));
  EXPECT_THAT(test::errorOf(ErrorCode::bad_file, [&] { readDepthImage(write("c.png", encodePng(gradient(2, 2)))); }),
              HasSubstr("a depth image must have one channel of 16 bits"));
}

TEST_F(ImageFile, RefusesWhatIsCutOffOrDamaged) {
  const std::string png = encodePng(gradient(20, 20)), jpeg = encodeJpeg(gradient(64, 64));
  for (const std::size_t size : {std::size_t(9), std::size_t(40), png.size() / 2, png.size() - 13}) {
    EXPECT_THAT(refusal(write("a.png", png.substr(0, size))), HasSubstr("a.png': ")) << size;
  }
  for (const std::size_t size : {std::size_t(4), std::size_t(200), jpeg.size() / 2}) {
    EXPECT_THAT(refusal(write("a.jpg", jpeg.substr(0, size))), HasSubstr("a.jpg': ")) << size;
  }
  std::string damaged = png;
  damaged[png.size() / 2] = char(damaged[png.size() / 2] ^ 0x55);
  EXPECT_THAT(refusal(write("b.png", damaged)), HasSubstr("b.png': "));
}

/// The size of a PNG, with the checksum that goes with it, before any memory is taken for the pixels.
TEST_F(ImageFile, RefusesHugePictures) {
  std::string huge = encodePng(ColorImage(1, 1)), jpeg = encodeJpeg(ColorImage(8, 8));
  const std::string header = text({0x00, 0x01, 0x86, 0xa0, 0x00, 0x01, 0x86, 0xa0, 0x08, 0x02, 0x00, 0x00, 0x00});
  std::uint32_t crc = 0xffffffff;
  for (const char c : "IHDR" + header) {
    crc ^= std::uint8_t(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xedb88320u : 0);
  }
  crc = ~crc;
  huge.replace(16, header.size(), header);
  for (int i = 0; i < 4; ++i) huge[std::size_t(29 + i)] = char(crc >> (24 - 8 * i));
  EXPECT_THAT(refusal(write("huge.png", huge)), HasSubstr("100000 x 100000 pixels, which is more than can be read"));
  const std::size_t frame = jpeg.find(text({0xff, 0xc0}));
  ASSERT_NE(frame, std::string::npos);
  jpeg.replace(frame + 5, 4, text({0xff, 0x00, 0xff, 0x00}));
  EXPECT_THAT(refusal(write("huge.jpg", jpeg)), HasSubstr("65280 x 65280 pixels"));
}

}  // namespace
}  // namespace sks
