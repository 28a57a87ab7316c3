// SPDX-License-Identifier: BSD-3-Clause
// PNG by libpng. It leaves by longjmp where something is wrong: between setjmp and that no object with a destructor may
// come into being, so that all of them are made before.
#include <algorithm>
#include <csetjmp>
#include <cstring>

#include <png.h>

#include "io/image_codec.hpp"

namespace sks {
namespace {

static_assert(sizeof(Rgb) == 3, "rows of Rgb are rows of bytes");

/// What libpng reads from or writes to, and its last complaint.
struct Stream {
  const std::string* input = nullptr;
  std::size_t position = 0;
  std::string output;
  char complaint[128] = "it is damaged";
};

void readBytes(png_structp png, png_bytep to, png_size_t size) {
  Stream& stream = *static_cast<Stream*>(png_get_io_ptr(png));
  if (size > stream.input->size() - stream.position) png_error(png, "it is cut off");
  std::memcpy(to, stream.input->data() + stream.position, size);
  stream.position += size;
}

void writeBytes(png_structp png, png_bytep from, png_size_t size) {
  static_cast<Stream*>(png_get_io_ptr(png))->output.append(reinterpret_cast<const char*>(from), size);
}

void complain(png_structp png, png_const_charp message) {
  Stream& stream = *static_cast<Stream*>(png_get_error_ptr(png));
  std::strncpy(stream.complaint, message, sizeof(stream.complaint) - 1);
  png_longjmp(png, 1);
}

void ignore(png_structp, png_const_charp) {}

template <typename Pixel>
class PngReader {
public:
  explicit PngReader(const std::string& bytes)
      : png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &stream_, complain, ignore)),
        info_(png_ != nullptr ? png_create_info_struct(png_) : nullptr) {
    stream_.input = &bytes;
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  Image<Pixel> read() {
    if (info_ == nullptr) throw CodecError("libpng cannot be used");
    readHeader();
    checkImageSize(png_get_image_width(png_, info_), png_get_image_height(png_, info_), stream_.input->size());
    Image<Pixel> image(int(png_get_image_width(png_, info_)), int(png_get_image_height(png_, info_)));
    readRows(image);
    return image;
  }

private:
  void readHeader() {
    if (setjmp(png_jmpbuf(png_))) throw CodecError(stream_.complaint);
    png_set_read_fn(png_, &stream_, readBytes);
    png_read_info(png_, info_);
  }

  void demand();  // rows of `Pixel`

  void readRows(Image<Pixel>& image) {
    if (setjmp(png_jmpbuf(png_))) throw CodecError(stream_.complaint);
    demand();
    const int passes = png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    if (png_get_rowbytes(png_, info_) != std::size_t(image.width) * sizeof(Pixel)) png_error(png_, "it is damaged");
    for (int pass = 0; pass < passes; ++pass) {
      for (int row = 0; row < image.height; ++row) {
        png_read_row(png_, reinterpret_cast<png_bytep>(&image(row, 0)), nullptr);
      }
    }
    png_read_end(png_, nullptr);
  }

  Stream stream_;
  png_structp png_;
  png_infop info_;
};

/// As 8-bit RGB.
template <>
void PngReader<Rgb>::demand() {
  png_set_strip_16(png_);
  png_set_strip_alpha(png_);
  png_set_palette_to_rgb(png_);
  png_set_expand_gray_1_2_4_to_8(png_);
  png_set_gray_to_rgb(png_);
}

template <>
void PngReader<std::uint16_t>::demand() {
  if (png_get_bit_depth(png_, info_) != 16 || png_get_color_type(png_, info_) != PNG_COLOR_TYPE_GRAY) {
    throw CodecError("a depth image must have one channel of 16 bits");
  }
  const std::uint16_t one = 1;
  if (*reinterpret_cast<const char*>(&one) == 1) png_set_swap(png_);
}

template <typename Pixel>
std::string encode(const Image<Pixel>& image, int bits, int color_type) {
  Stream stream;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &stream, complain, ignore);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  if (info == nullptr || setjmp(png_jmpbuf(png))) {
    png_destroy_write_struct(&png, &info);
    throw CodecError(stream.complaint);
  }
  png_set_write_fn(png, &stream, writeBytes, nullptr);
  // Fast, and good enough for depth and for drawings.
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
  png_set_compression_level(png, 1);
  png_set_compression_strategy(png, 3);  // run lengths
  png_set_IHDR(png, info, png_uint_32(image.width), png_uint_32(image.height), bits, color_type, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  const std::uint16_t one = 1;
  if (bits == 16 && *reinterpret_cast<const char*>(&one) == 1) png_set_swap(png);
  for (int row = 0; row < image.height; ++row) {
    png_write_row(png, reinterpret_cast<png_const_bytep>(&image(row, 0)));
  }
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return std::move(stream.output);
}

}  // namespace

void checkImageSize(std::uint64_t width, std::uint64_t height, std::size_t bytes) {
  constexpr std::uint64_t most_pixels_per_byte = 8300;  // of a PNG with one bit a pixel; JPEG reaches far less
  if (width == 0 || height == 0) throw CodecError("it has no pixels");
  if (width * height > max_image_pixels) {
    throw CodecError("it has " + std::to_string(width) + " x " + std::to_string(height) +
                     " pixels, which is more than can be read (8192 x 8192); make it smaller");
  }
  if (width * height > most_pixels_per_byte * bytes) throw CodecError("it is cut off");
}

ColorImage decodeColorPng(const std::string& bytes) {
  return PngReader<Rgb>(bytes).read();
}

DepthImage decodeDepthPng(const std::string& bytes) {
  return PngReader<std::uint16_t>(bytes).read();
}

std::string encodePng(const ColorImage& image) {
  return encode(image, 8, PNG_COLOR_TYPE_RGB);
}

std::string encodePng(const DepthImage& image) {
  return encode(image, 16, PNG_COLOR_TYPE_GRAY);
}

}  // namespace sks
