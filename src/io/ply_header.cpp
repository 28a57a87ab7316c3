// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>

#include <sks_detector/error.hpp>

#include "core/settings/shown_text.hpp"
#include "io/header_lines.hpp"
#include "io/ply_file.hpp"

namespace sks {
namespace {

using PlyWords = std::vector<std::string>;

[[noreturn]] void badPlyHeader(const std::string& message) {
  throw Error(ErrorCode::bad_data, "its PLY header " + message);
}

PointField::Type typeOf(const std::string& name) {
  static const std::map<std::string, PointField::Type> types = {
      {"char", PointField::int8},      {"int8", PointField::int8},       {"uchar", PointField::uint8},
      {"uint8", PointField::uint8},    {"short", PointField::int16},     {"int16", PointField::int16},
      {"ushort", PointField::uint16},  {"uint16", PointField::uint16},   {"int", PointField::int32},
      {"int32", PointField::int32},    {"uint", PointField::uint32},     {"uint32", PointField::uint32},
      {"float", PointField::float32},  {"float32", PointField::float32}, {"double", PointField::float64},
      {"float64", PointField::float64}};
  const auto found = types.find(name);
  if (found == types.end()) badPlyHeader("has a property of the unknown type '" + shown(name) + "'");
  return found->second;
}

PlyFormat formatOf(const std::string& name) {
  const PlyWords names = {"ascii", "binary_little_endian", "binary_big_endian"};
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) badPlyHeader("has the unknown format '" + shown(name) + "'");
  return PlyFormat(found - names.begin());
}

PlyProperty propertyOf(const PlyWords& words) {
  if (words.size() == 3) return {words[2], typeOf(words[1])};
  if (words.size() == 5 && words[1] == "list") return {words[4], typeOf(words[3]), true, typeOf(words[2])};
  badPlyHeader("has a property without a type or name");
}

std::string joined(PlyWords::const_iterator word, PlyWords::const_iterator end) {
  std::string text;
  for (; word != end; ++word) text += (text.empty() ? "" : " ") + *word;
  return text;
}

}  // namespace

PlyHeader readPlyHeader(std::istream& file) {
  PlyHeader header;
  bool has_format = false;
  HeaderLines lines(file);
  for (PlyWords words; words.empty() || words[0] != "end_header";) {
    if (!lines.next(words)) badPlyHeader("has no line end_header");
    const std::string keyword = words.empty() ? "" : words[0];
    if (keyword == "format" && words.size() > 1) {
      header.format = formatOf(words[1]);
      has_format = true;
    } else if (keyword == "element") {
      if (words.size() != 3) badPlyHeader("has an element without a name or count");
      header.elements.push_back({words[1], headerNumber(words[2], "element " + words[1]), {}});
    } else if (keyword == "property") {
      if (header.elements.empty()) badPlyHeader("has a property before the first element");
      header.elements.back().properties.push_back(propertyOf(words));
    } else if (keyword == "comment" && words.size() > 2 && words[1] == "TextureFile") {
      header.textures.push_back(joined(words.begin() + 2, words.end()));
    }
  }
  if (!has_format) badPlyHeader("has no line format");
  return header;
}

}  // namespace sks
