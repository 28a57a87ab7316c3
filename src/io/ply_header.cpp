// SPDX-License-Identifier: BSD-3-Clause
#include <map>
#include <vector>

#include <sks_detector/error.hpp>

#include "io/header_lines.hpp"
#include "io/ply_file.hpp"

namespace sks {
namespace {

[[noreturn]] void fail(const std::string& message) {
  throw Error(ErrorCode::bad_data, "its PLY header " + message);
}

std::uint64_t typeSize(const std::string& type) {
  static const std::map<std::string, std::uint64_t> sizes = {
      {"char", 1},   {"int8", 1},    {"uchar", 1},  {"uint8", 1},  {"short", 2}, {"int16", 2},
      {"ushort", 2}, {"uint16", 2},  {"int", 4},    {"int32", 4},  {"uint", 4},  {"uint32", 4},
      {"float", 4},  {"float32", 4}, {"double", 8}, {"float64", 8}};
  const auto found = sizes.find(type);
  if (found == sizes.end()) fail("has a property of the unknown type '" + type + "'");
  return found->second;
}

/// What the header says of the vertices.
struct Vertices {
  bool ascii = false;
  std::uint64_t count = 0;
  std::uint64_t properties = 0;
  std::uint64_t bytes = 0;  // of one vertex with empty lists
};

Vertices readHeader(std::istream& file) {
  Vertices vertices;
  std::string format, element;
  for (std::vector<std::string> words;;) {
    if (!readHeaderLine(file, words)) fail("has no line end_header");
    if (words.empty()) continue;
    if (words[0] == "end_header") break;
    if (words[0] == "format" && words.size() > 1) format = words[1];
    if (words[0] == "element") {
      if (words.size() != 3) fail("has an element without a name or count");
      element = words[1];
      const std::uint64_t count = headerNumber(words[2], "element " + element);
      if (element == "vertex") vertices.count = count;
    }
    if (words[0] == "property" && element == "vertex") {
      if (words.size() < 3) fail("has a property without a type or name");
      vertices.properties += 1;
      vertices.bytes += typeSize(words[1] == "list" ? words[2] : words[1]);
    }
  }
  if (format != "ascii" && format != "binary_little_endian" && format != "binary_big_endian") {
    fail("has the unknown format '" + format + "'");
  }
  vertices.ascii = format == "ascii";
  return vertices;
}

}  // namespace

std::uint64_t checkPlyHeader(std::istream& file, std::uint64_t file_size) {
  const Vertices vertices = readHeader(file);
  const std::uint64_t there = file_size - std::uint64_t(file.tellg());
  if (vertices.count > 0 && vertices.properties == 0) fail("has no properties of a vertex");
  const double each = vertices.ascii ? 2.0 * double(vertices.properties) : double(vertices.bytes);
  checkHolds(vertices.count, double(vertices.count) * each - (vertices.ascii ? 1 : 0), there);
  return vertices.count;
}

}  // namespace sks
