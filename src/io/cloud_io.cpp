// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/cloud_io.hpp>

#include <cstring>
#include <filesystem>
#include <vector>

#include <sks_detector/error.hpp>

#include "core/settings/value_text.hpp"
#include "io/atomic_file.hpp"
#include "io/file_content.hpp"
#include "io/header_lines.hpp"
#include "io/memory_stream.hpp"
#include "io/pcd_file.hpp"
#include "io/ply_file.hpp"

namespace sks {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw Error(ErrorCode::bad_file, "cannot read cloud '" + path + "': " + reason);
}

enum class Format { pcd, ply, foreign };

/// By the first line, whatever the file is called. Leaves the file where its text begins: behind the mark that some
/// editors put before UTF-8.
Format formatOf(std::istream& file) {
  char mark[3] = {};
  const bool marked = file.read(mark, 3) && std::string(mark, 3) == "\xef\xbb\xbf";
  const auto begin = [&] {
    file.clear();
    file.seekg(marked ? 3 : 0);
  };
  begin();
  std::vector<std::string> words;
  const bool text = HeaderLines(file).next(words) && !words.empty();
  begin();
  if (!text) return Format::foreign;
  if (words[0] == "ply" || words[0] == "PLY") return Format::ply;
  return words[0][0] == '#' || words[0] == "VERSION" || words[0] == "FIELDS" ? Format::pcd : Format::foreign;
}

Cloud read(std::istream& file, std::uint64_t size, double scale) {
  switch (formatOf(file)) {
    case Format::pcd:
      return readPcd(file, size, scale);
    case Format::ply:
      return readPly(file, size, scale);
    default:
      throw Error(ErrorCode::bad_data, size == 0 ? "it is empty" : "it is neither a PCD nor a PLY file");
  }
}

}  // namespace

Cloud readCloud(const std::string& path, double scale) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) fail(path, "it is a folder; give the name of a PCD or PLY file");
  try {
    const FileContent content(path);
    MemoryStream file(content.data(), content.size());
    Cloud cloud = read(file, content.size(), scale);
    if (!cloud.sensor_origin.allFinite()) throw Error(ErrorCode::bad_data, "its sensor origin is not finite");
    return cloud;
  } catch (const Error& reason) {
    fail(path, reason.what());
  }
}

void writeCloud(const std::string& path, const Cloud& cloud) {
  const bool color = cloud.hasColor();
  std::string header = "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n";
  header += color ? "FIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\n"
                  : "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n";
  header +=
      "WIDTH " + std::to_string(cloud.columnCount()) + "\nHEIGHT " + std::to_string(cloud.rowCount()) + "\nVIEWPOINT ";
  for (int axis = 0; axis < 3; ++axis) header += toText(double(cloud.sensor_origin[axis])) + " ";
  header += "1 0 0 0\nPOINTS " + std::to_string(cloud.size()) + "\nDATA binary\n";

  const std::size_t step = color ? 16 : 12;
  std::vector<char> data(cloud.size() * step);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    std::memcpy(&data[i * step], cloud.points[i].data(), 12);
    if (!color) continue;
    const Rgb& rgb = cloud.colors[i];
    const std::uint32_t packed = std::uint32_t(rgb.r) << 16 | std::uint32_t(rgb.g) << 8 | rgb.b;
    std::memcpy(&data[i * step + 12], &packed, 4);
  }
  AtomicFile file(path);
  file.write(header.data(), header.size());
  file.write(data.data(), data.size());
  file.commit();
}

}  // namespace sks
