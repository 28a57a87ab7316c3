// SPDX-License-Identifier: BSD-3-Clause
#include "io/ply_values.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

#include <sks_detector/error.hpp>

#include "core/settings/shown_text.hpp"
#include "io/header_lines.hpp"
#include "io/number_text.hpp"

namespace sks {
namespace {

[[noreturn]] void badValues(const std::string& message) {
  throw Error(ErrorCode::bad_data, message);
}

/// Fewest bytes of one instance in the file: of a number in text, a digit and a blank.
double leastBytes(const PlyElement& element, PlyFormat format) {
  static const double sizes[] = {0, 1, 1, 2, 2, 4, 4, 4, 8};  // by PointField::Type
  double bytes = 0;
  for (const PlyProperty& property : element.properties) {
    bytes += format == PlyFormat::ascii ? 2 : sizes[property.list ? property.count_type : property.type];
  }
  return bytes;
}

}  // namespace

double PlyValues::next(PointField::Type type) {
  switch (type) {
    case PointField::int8:
      return number<std::int8_t>();
    case PointField::uint8:
      return number<std::uint8_t>();
    case PointField::int16:
      return number<std::int16_t>();
    case PointField::uint16:
      return number<std::uint16_t>();
    case PointField::int32:
      return number<std::int32_t>();
    case PointField::uint32:
      return number<std::uint32_t>();
    case PointField::float32:
      return number<float>();
    default:
      return number<double>();
  }
}

template <typename T>
double PlyValues::number() {
  if (format_ == PlyFormat::ascii) {
    const double value = word();
    if (std::is_integral_v<T> && !std::isfinite(value)) badValues("it holds '" + shown(word_) + "' for a whole number");
    return value;
  }
  char bytes[sizeof(T)];
  if (!file_.read(bytes, sizeof(T))) badValues("it is truncated");
  if (format_ == PlyFormat::binary_big_endian) std::reverse(bytes, bytes + sizeof(T));
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return double(value);
}

double PlyValues::word() {
  double value = 0;
  if (!(file_ >> word_)) badValues("it is truncated");
  if (!parseNumber(word_, value)) badValues("it holds '" + shown(word_) + "', no number");
  return value;
}

void PlyValues::read(const PlyElement& element, PlyInstance& instance) {
  instance.values.assign(element.properties.size(), 0);
  instance.lists.resize(element.properties.size());
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    instance.lists[i].clear();
    if (!property.list) {
      instance.values[i] = next(property.type);
      continue;
    }
    const double count = next(property.count_type);
    if (!(count >= 0 && count <= double(std::numeric_limits<std::uint32_t>::max()))) {
      badValues("a list has a wrong length");
    }
    for (std::uint64_t k = 0; k < std::uint64_t(count); ++k) instance.lists[i].push_back(next(property.type));
  }
}

void PlyValues::skip(const PlyElement& element) {
  PlyInstance ignored;
  for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i) read(element, ignored);
}

void checkElement(const PlyElement& element, PlyFormat format, std::uint64_t bytes_left) {
  const double last_blank = format == PlyFormat::ascii ? 1 : 0;
  checkHolds(element.count, std::max(0.0, double(element.count) * leastBytes(element, format) - last_blank),
             bytes_left);
}

std::vector<std::string> plyValueNames(const PlyElement& element) {
  std::vector<std::string> names;
  for (const PlyProperty& property : element.properties) names.push_back(property.list ? "" : property.name);
  return names;
}

std::size_t plyIndex(const PlyElement& element, const std::string& name, bool list) {
  const auto found =
      std::find_if(element.properties.begin(), element.properties.end(),
                   [&](const PlyProperty& property) { return property.name == name && property.list == list; });
  return found == element.properties.end() ? ply_absent : std::size_t(found - element.properties.begin());
}

}  // namespace sks
