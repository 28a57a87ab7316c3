// SPDX-License-Identifier: BSD-3-Clause
// JPEG by libjpeg. It leaves by longjmp where something is wrong: between setjmp and that no object with a destructor
// may come into being.
#include <csetjmp>
#include <cstdio>
#include <cstdlib>

#include <jpeglib.h>

#include <jerror.h>

#include "io/image_codec.hpp"

namespace sks {
namespace {

constexpr int quality = 95;

struct Failure {
  jpeg_error_mgr base;  // the first one: libjpeg knows no more of it
  std::jmp_buf jump;
  char complaint[JMSG_LENGTH_MAX];
};

void complain(j_common_ptr codec) {
  Failure& failure = *reinterpret_cast<Failure*>(codec->err);
  codec->err->format_message(codec, failure.complaint);
  std::longjmp(failure.jump, 1);
}

/// Warnings are not printed; what ends too early is refused.
void heed(j_common_ptr codec, int level) {
  if (level < 0 && codec->err->msg_code == JWRN_JPEG_EOF) complain(codec);
}

void prepare(Failure& failure, jpeg_error_mgr*& manager) {
  manager = jpeg_std_error(&failure.base);
  failure.base.error_exit = complain;
  failure.base.emit_message = heed;
}

class Reader {
public:
  explicit Reader(const std::string& bytes) : bytes_(bytes) { prepare(failure_, codec_.err); }
  ~Reader() { jpeg_destroy_decompress(&codec_); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  ColorImage read() {
    readHeader();
    checkImageSize(codec_.image_width, codec_.image_height, bytes_.size());
    ColorImage image(int(codec_.image_width), int(codec_.image_height));
    readRows(image);
    return image;
  }

private:
  void readHeader() {
    if (setjmp(failure_.jump)) throw CodecError(failure_.complaint);
    jpeg_create_decompress(&codec_);
    jpeg_mem_src(&codec_, reinterpret_cast<const unsigned char*>(bytes_.data()), bytes_.size());
    jpeg_read_header(&codec_, TRUE);
  }

  void readRows(ColorImage& image) {
    if (setjmp(failure_.jump)) throw CodecError(failure_.complaint);
    codec_.out_color_space = JCS_RGB;
    jpeg_start_decompress(&codec_);
    while (codec_.output_scanline < codec_.output_height) {
      JSAMPROW row = reinterpret_cast<JSAMPROW>(&image(int(codec_.output_scanline), 0));
      jpeg_read_scanlines(&codec_, &row, 1);
    }
    jpeg_finish_decompress(&codec_);
  }

  const std::string& bytes_;
  jpeg_decompress_struct codec_{};
  Failure failure_;
};

}  // namespace

ColorImage decodeJpeg(const std::string& bytes) {
  return Reader(bytes).read();
}

std::string encodeJpeg(const ColorImage& image) {
  jpeg_compress_struct codec{};
  Failure failure;
  unsigned char* bytes = nullptr;
  unsigned long size = 0;  // NOLINT(google-runtime-int): libjpeg's
  prepare(failure, codec.err);
  if (setjmp(failure.jump)) {
    jpeg_destroy_compress(&codec);
    std::free(bytes);
    throw CodecError(failure.complaint);
  }
  jpeg_create_compress(&codec);
  jpeg_mem_dest(&codec, &bytes, &size);
  codec.image_width = JDIMENSION(image.width);
  codec.image_height = JDIMENSION(image.height);
  codec.input_components = 3;
  codec.in_color_space = JCS_RGB;
  jpeg_set_defaults(&codec);
  jpeg_set_quality(&codec, quality, TRUE);
  jpeg_start_compress(&codec, TRUE);
  while (codec.next_scanline < codec.image_height) {
    JSAMPROW row = const_cast<JSAMPROW>(reinterpret_cast<const JSAMPLE*>(&image(int(codec.next_scanline), 0)));
    jpeg_write_scanlines(&codec, &row, 1);
  }
  jpeg_finish_compress(&codec);
  jpeg_destroy_compress(&codec);
  std::string result(reinterpret_cast<const char*>(bytes), size);
  std::free(bytes);
  return result;
}

}  // namespace sks
