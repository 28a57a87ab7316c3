// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <type_traits>

#include <sks_detector/error.hpp>

#include "core/settings/shown_text.hpp"
#include "io/header_lines.hpp"
#include "io/number_text.hpp"
#include "io/ply_file.hpp"
#include "io/point_colors.hpp"

namespace sks {
namespace {

[[noreturn]] void badPly(const std::string& message) {
  throw Error(ErrorCode::bad_data, message);
}

/// Reads value by value; all types of PLY fit into a double.
class Values {
public:
  Values(std::istream& file, PlyFormat format) : file_(file), format_(format) {}

  double next(PointField::Type type) {
    switch (type) {
      case PointField::int8:
        return read<std::int8_t>();
      case PointField::uint8:
        return read<std::uint8_t>();
      case PointField::int16:
        return read<std::int16_t>();
      case PointField::uint16:
        return read<std::uint16_t>();
      case PointField::int32:
        return read<std::int32_t>();
      case PointField::uint32:
        return read<std::uint32_t>();
      case PointField::float32:
        return read<float>();
      default:
        return read<double>();
    }
  }

private:
  template <typename T>
  double read() {
    if (format_ == PlyFormat::ascii) {
      const double value = readWord();
      if (std::is_integral_v<T> && !std::isfinite(value)) badPly("it holds '" + shown(word_) + "' for a whole number");
      return value;
    }
    char bytes[sizeof(T)];
    if (!file_.read(bytes, sizeof(T))) badPly("it is truncated");
    if (format_ == PlyFormat::binary_big_endian) std::reverse(bytes, bytes + sizeof(T));
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return double(value);
  }

  double readWord() {
    double value = 0;
    if (!(file_ >> word_)) badPly("it is truncated");
    if (!parseNumber(word_, value)) badPly("it holds '" + shown(word_) + "', no number");
    return value;
  }

  std::istream& file_;
  PlyFormat format_;
  std::string word_;
};

/// The values of one instance of an element; those of lists are passed over and stand as 0.
void readInstance(Values& values, const PlyElement& element, std::vector<double>& row) {
  row.clear();
  for (const PlyProperty& property : element.properties) {
    if (!property.list) {
      row.push_back(values.next(property.type));
      continue;
    }
    const double count = values.next(property.count_type);
    if (!(count >= 0 && count <= double(std::numeric_limits<std::uint32_t>::max())))
      badPly("a list has a wrong length");
    for (std::uint64_t i = 0; i < std::uint64_t(count); ++i) values.next(property.type);
    row.push_back(0);
  }
}

constexpr std::size_t absent = std::numeric_limits<std::size_t>::max();

std::size_t indexOf(const PlyElement& element, const std::string& name) {
  const auto found = std::find_if(element.properties.begin(), element.properties.end(),
                                  [&](const PlyProperty& property) { return property.name == name && !property.list; });
  return found == element.properties.end() ? absent : std::size_t(found - element.properties.begin());
}

std::array<std::size_t, 3> indicesOf(const PlyElement& element, const std::array<const char*, 3>& names) {
  return {indexOf(element, names[0]), indexOf(element, names[1]), indexOf(element, names[2])};
}

bool complete(const std::array<std::size_t, 3>& indices) {
  return std::find(indices.begin(), indices.end(), absent) == indices.end();
}

std::array<std::size_t, 3> coordinates(const PlyElement& vertices) {
  const std::array<const char*, 3> names = {"x", "y", "z"};
  const auto indices = indicesOf(vertices, names);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string name = std::string("property '") + names[i] + "'";
    if (indices[i] == absent) badPly("its vertices have no " + name);
    const PointField::Type type = vertices.properties[indices[i]].type;
    if (type != PointField::float32 && type != PointField::float64) {
      badPly(name + " of its vertices holds integers; coordinates must be float or double");
    }
  }
  return indices;
}

std::vector<std::string> namesOfValues(const PlyElement& element) {
  std::vector<std::string> names;
  for (const PlyProperty& property : element.properties) names.push_back(property.list ? "" : property.name);
  return names;
}

/// The colours of vertices, value by value.
class VertexColors {
public:
  explicit VertexColors(const PlyElement& vertices)
      : packed_(packedColorField(namesOfValues(vertices))), places_(colorChannelFields(namesOfValues(vertices))) {
    if (packed_ && vertices.properties[*packed_].type < PointField::int32) packed_.reset();  // no room for three bytes
    if (packed_) as_float_ = vertices.properties[*packed_].type == PointField::float32;
    for (std::size_t i = 0; places_ && i < 3; ++i) types_[i] = vertices.properties[(*places_)[i]].type;
  }

  void add(const std::vector<double>& row) {
    if (packed_) {
      colors_.push_back(unpackedColor(bitsOf(row[*packed_])));
    } else if (places_) {
      channels_.emplace_back(float(row[(*places_)[0]]), float(row[(*places_)[1]]), float(row[(*places_)[2]]));
    }
  }

  std::vector<Rgb> take() { return packed_ ? std::move(colors_) : colorsOfChannels(channels_, types_); }

private:
  std::uint32_t bitsOf(double value) const {
    if (!as_float_) return std::abs(value) < 4294967296.0 ? std::uint32_t(std::int64_t(value)) : 0;
    const auto narrow = float(value);
    std::uint32_t bits = 0;
    std::memcpy(&bits, &narrow, sizeof(bits));
    return bits;
  }

  std::optional<std::size_t> packed_;
  std::optional<std::array<std::size_t, 3>> places_;
  std::array<std::uint8_t, 3> types_{};
  bool as_float_ = false;
  std::vector<Eigen::Vector3f> channels_;
  std::vector<Rgb> colors_;
};

/// Fewest bytes of one instance in the file: of a number in text, a digit and a blank.
double leastBytes(const PlyElement& element, PlyFormat format) {
  static const double sizes[] = {0, 1, 1, 2, 2, 4, 4, 4, 8};  // by PointField::Type
  double bytes = 0;
  for (const PlyProperty& property : element.properties) {
    bytes += format == PlyFormat::ascii ? 2 : sizes[property.list ? property.count_type : property.type];
  }
  return bytes;
}

void readVertices(Values& values, const PlyElement& element, double scale, Cloud& cloud) {
  const auto axes = coordinates(element);
  VertexColors colors(element);
  cloud.width = std::uint32_t(element.count);
  cloud.points.reserve(element.count);
  std::vector<double> row;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    readInstance(values, element, row);
    cloud.points.emplace_back(float(scale * row[axes[0]]), float(scale * row[axes[1]]), float(scale * row[axes[2]]));
    colors.add(row);
  }
  cloud.colors = colors.take();
}

void readCamera(Values& values, const PlyElement& element, double scale, Cloud& cloud) {
  const auto origin = indicesOf(element, {"view_px", "view_py", "view_pz"});
  std::vector<double> row;
  readInstance(values, element, row);
  if (!complete(origin)) return;
  for (int axis = 0; axis < 3; ++axis) cloud.sensor_origin[axis] = float(scale * row[origin[std::size_t(axis)]]);
}

}  // namespace

Cloud readPly(std::istream& file, std::uint64_t file_size, double scale) {
  const PlyHeader header = readPlyHeader(file);
  const std::uint64_t there = file_size - std::uint64_t(file.tellg());
  Values values(file, header.format);
  Cloud cloud;
  bool has_vertices = false;
  std::vector<double> row;
  for (const PlyElement& element : header.elements) {
    const double last_blank = header.format == PlyFormat::ascii ? 1 : 0;
    if (element.count == 0 && element.name != "vertex") continue;
    checkHolds(element.count, std::max(0.0, double(element.count) * leastBytes(element, header.format) - last_blank),
               there);
    if (element.name == "vertex" && !has_vertices) {
      has_vertices = true;
      readVertices(values, element, scale, cloud);
    } else if (element.name == "camera") {
      readCamera(values, element, scale, cloud);
    } else {
      for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i) {
        readInstance(values, element, row);
      }
    }
  }
  if (!has_vertices) badPly("its PLY header has no element vertex");
  return cloud;
}

}  // namespace sks
