// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>
#include <numeric>

#include <sks_detector/error.hpp>

#include "core/settings/shown_text.hpp"
#include "core/settings/value_text.hpp"
#include "io/header_lines.hpp"
#include "io/pcd_file.hpp"

namespace sks {
namespace {

using Words = std::vector<std::string>;
using Entries = std::map<std::string, Words>;

[[noreturn]] void badPcdHeader(const std::string& message) {
  throw Error(ErrorCode::bad_data, "its PCD header " + message);
}

const Words& entry(const Entries& entries, const std::string& name) {
  const auto found = entries.find(name);
  if (found == entries.end() || found->second.empty()) badPcdHeader("has no " + name);
  return found->second;
}

/// Every line up to DATA by its first word.
Entries readEntries(std::istream& file) {
  Entries entries;
  HeaderLines lines(file);
  for (Words words; entries.count("DATA") == 0;) {
    if (!lines.next(words)) badPcdHeader("has no line DATA");
    if (words.empty() || words[0][0] == '#') continue;
    const std::string name = words[0] == "COLUMNS" ? "FIELDS" : words[0];
    entries[name] = {words.begin() + 1, words.end()};
  }
  return entries;
}

std::vector<PcdField> readFields(const Entries& entries) {
  const Words& names = entry(entries, "FIELDS");
  const Words& sizes = entry(entries, "SIZE");
  const Words& types = entry(entries, "TYPE");
  const Words counts = entries.count("COUNT") ? entry(entries, "COUNT") : Words(names.size(), "1");
  if (sizes.size() != names.size() || types.size() != names.size() || counts.size() != names.size()) {
    badPcdHeader("has lines FIELDS, SIZE, TYPE and COUNT of different lengths");
  }
  std::vector<PcdField> fields;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::uint64_t size = headerNumber(sizes[i], "SIZE"), count = headerNumber(counts[i], "COUNT");
    const bool real = types[i] == "F" && (size == 4 || size == 8);
    const bool whole = (types[i] == "I" || types[i] == "U") && (size == 1 || size == 2 || size == 4 || size == 8);
    const std::string of_field = " for field '" + shown(names[i]) + "'";
    if (!real && !whole) badPcdHeader("says TYPE " + shown(types[i]) + " of SIZE " + sizes[i] + of_field);
    if (count < 1 || count > 65536) badPcdHeader("says COUNT " + counts[i] + of_field);
    fields.push_back({names[i], types[i][0], std::uint32_t(size), std::uint32_t(count)});
  }
  return fields;
}

Eigen::Vector3d readViewpoint(const Entries& entries) {
  Eigen::Vector3d viewpoint = Eigen::Vector3d::Zero();
  if (entries.count("VIEWPOINT") == 0) return viewpoint;
  const Words& words = entry(entries, "VIEWPOINT");
  for (int axis = 0; axis < 3; ++axis) {
    if (words.size() != 7 || !fromText(words[std::size_t(axis)], viewpoint[axis])) {
      badPcdHeader("has a VIEWPOINT that is not seven numbers");
    }
  }
  return viewpoint;
}

}  // namespace

std::uint64_t PcdHeader::valuesOfPoint() const {
  return std::accumulate(fields.begin(), fields.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const PcdField& field) { return sum + field.count; });
}

std::uint64_t PcdHeader::bytesOfPoint() const {
  return std::accumulate(fields.begin(), fields.end(), std::uint64_t{0}, [](std::uint64_t sum, const PcdField& field) {
    return sum + std::uint64_t(field.count) * field.size;
  });
}

PcdHeader readPcdHeader(std::istream& file) {
  const Entries entries = readEntries(file);
  PcdHeader header;
  header.fields = readFields(entries);
  header.viewpoint = readViewpoint(entries);

  const std::uint64_t width = headerNumber(entry(entries, "WIDTH")[0], "WIDTH");
  const std::uint64_t height = entries.count("HEIGHT") ? headerNumber(entry(entries, "HEIGHT")[0], "HEIGHT") : 1;
  const std::uint64_t points = headerNumber(entry(entries, "POINTS")[0], "POINTS");
  if (std::max({width, height, points}) > 4294967295u || width * height != points) {
    badPcdHeader("says WIDTH " + std::to_string(width) + ", HEIGHT " + std::to_string(height) + " and POINTS " +
                 std::to_string(points) + ", which do not fit");
  }
  header.width = std::uint32_t(width);
  header.height = std::uint32_t(height);

  const std::string& data = entry(entries, "DATA")[0];
  const Words kinds = {"ascii", "binary", "binary_compressed"};
  const auto kind = std::find(kinds.begin(), kinds.end(), data);
  if (kind == kinds.end()) badPcdHeader("says DATA " + shown(data) + "; known are ascii, binary and binary_compressed");
  header.data = PcdData(kind - kinds.begin());
  return header;
}

}  // namespace sks
