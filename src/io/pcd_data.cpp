// SPDX-License-Identifier: BSD-3-Clause
#include <cstdlib>
#include <cstring>

#include <sks_detector/error.hpp>

#include "core/settings/shown_text.hpp"
#include "io/header_lines.hpp"
#include "io/lzf.hpp"
#include "io/number_text.hpp"
#include "io/pcd_file.hpp"
#include "io/point_colors.hpp"
#include "io/point_fields.hpp"

namespace sks {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// A compressor's best: 264 bytes out of 3.
constexpr std::uint64_t best_compression = 88;

[[noreturn]] void fail(const std::string& message) {
  throw Error(ErrorCode::bad_data, message);
}

/// Writes a number in its binary form; false where the text is no number.
bool storeNumber(const std::string& text, const PcdField& field, std::uint8_t* to) {
  // a packed colour that is written as the whole number that its four bytes make, whatever its type is said to be
  const bool whole = packedColorField({field.name}) && field.size == 4 && field.count == 1 &&
                     text.find_first_not_of("0123456789") == std::string::npos;
  if (field.type == 'F' && !whole) {
    double value = 0;
    if (!parseNumber(text, value)) return false;
    const float narrow = float(value);
    std::memcpy(to, field.size == 8 ? static_cast<const void*>(&value) : &narrow, field.size);
    return true;
  }
  char* end = nullptr;
  const long long value =
      field.type == 'I' ? std::strtoll(text.c_str(), &end, 10) : (long long)(std::strtoull(text.c_str(), &end, 10));
  std::memcpy(to, &value, field.size);  // the low bytes: little endian
  return end == text.c_str() + text.size() && !text.empty();
}

Bytes readAscii(std::istream& file, const PcdHeader& header) {
  Bytes data(header.points() * header.bytesOfPoint());
  std::uint8_t* to = data.data();
  std::string word;
  for (std::uint64_t point = 0; point < header.points(); ++point) {
    for (const PcdField& field : header.fields) {
      for (std::uint32_t i = 0; i < field.count; ++i, to += field.size) {
        if (!(file >> word)) fail("it is truncated: " + std::to_string(point) + " of its points are there");
        if (!storeNumber(word, field, to))
          fail("point " + std::to_string(point) + " holds '" + shown(word) + "', no number");
      }
    }
  }
  return data;
}

Bytes readBinary(std::istream& file, std::uint64_t size) {
  Bytes data(size);
  if (!file.read(reinterpret_cast<char*>(data.data()), std::streamsize(size))) fail("its data cannot be read");
  return data;
}

std::uint64_t littleEndian(const Bytes& bytes, std::size_t at) {
  return std::uint64_t(bytes[at]) | std::uint64_t(bytes[at + 1]) << 8 | std::uint64_t(bytes[at + 2]) << 16 |
         std::uint64_t(bytes[at + 3]) << 24;
}

/// Compressed data lie field by field, all points of the first one first.
Bytes readCompressed(std::istream& file, const PcdHeader& header, std::uint64_t bytes_there) {
  const std::uint64_t points = header.points(), step = header.bytesOfPoint();
  checkHolds(points, 8, bytes_there);
  const Bytes lengths = readBinary(file, 8);
  const std::uint64_t packed = littleEndian(lengths, 0), unpacked = littleEndian(lengths, 4);
  checkHolds(points, double(packed), bytes_there - 8);
  if (unpacked != points * step || unpacked > best_compression * packed) {
    fail("its compressed data says " + std::to_string(unpacked) + " bytes, its header " +
         std::to_string(points * step));
  }
  const Bytes from = readBinary(file, packed);
  Bytes by_field, data(unpacked);
  if (!decompressLzf(from, unpacked, by_field)) fail("its compressed data is damaged");
  const std::uint8_t* next = by_field.data();
  std::uint64_t offset = 0;
  for (const PcdField& field : header.fields) {
    const std::size_t size = std::size_t(field.size) * field.count;
    for (std::uint64_t i = 0; i < points; ++i, next += size) std::memcpy(&data[i * step + offset], next, size);
    offset += size;
  }
  return data;
}

std::uint8_t pointFieldType(const PcdField& field) {
  if (field.type == 'F') return field.size == 4 ? PointField::float32 : PointField::float64;
  const bool is_signed = field.type == 'I';
  if (field.size == 1) return is_signed ? PointField::int8 : PointField::uint8;
  if (field.size == 2) return is_signed ? PointField::int16 : PointField::uint16;
  return is_signed ? PointField::int32 : PointField::uint32;  // no type of PointField has 8 bytes, and none is read
}

}  // namespace

std::vector<std::uint8_t> readPcdData(std::istream& file, const PcdHeader& header, std::uint64_t file_size) {
  const std::uint64_t points = header.points(), there = file_size - std::uint64_t(file.tellg());
  const double bytes = double(points) * double(header.bytesOfPoint());
  if (points == 0) return {};
  switch (header.data) {
    case PcdData::ascii:  // a digit and a blank for each value
      checkHolds(points, 2.0 * double(points) * double(header.valuesOfPoint()) - 1, there);
      return readAscii(file, header);
    case PcdData::binary:
      checkHolds(points, bytes, there);
      return readBinary(file, std::uint64_t(bytes));
    default:
      checkHolds(points, bytes / double(best_compression), there);
      return readCompressed(file, header, there);
  }
}

Cloud readPcd(std::istream& file, std::uint64_t file_size, double scale) {
  const PcdHeader header = readPcdHeader(file);
  const Bytes data = readPcdData(file, header, file_size);
  PointBlock block;
  block.width = header.width;
  block.height = header.height;
  block.point_step = header.bytesOfPoint();
  block.row_step = block.point_step * header.width;
  block.data = data.data();
  block.size = data.size();
  std::uint32_t offset = 0;
  for (const PcdField& field : header.fields) {
    block.fields.push_back({field.name, offset, pointFieldType(field), field.count});
    offset += field.size * field.count;
  }
  Cloud cloud = toCloud(block, scale);
  cloud.sensor_origin = (scale * header.viewpoint).cast<float>();
  return cloud;
}

}  // namespace sks
