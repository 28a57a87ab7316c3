// SPDX-License-Identifier: BSD-3-Clause
#include "tools/import/off_mesh.hpp"

#include <sstream>

#include <sks_detector/error.hpp>

#include "io/file.hpp"
#include "io/number_text.hpp"

namespace sks::tools {
namespace {

constexpr std::size_t largest_file = std::size_t(1) << 30;

class OffReader {
public:
  explicit OffReader(const std::string& path) : path_(path), text_(plainStream(readTextFile(path, largest_file))) {}

  OffMesh read() {
    std::string line = nextLine("'OFF'");
    if (line.compare(0, 3, "OFF") != 0) fail("the file does not begin with 'OFF': it is no OFF file");
    line.erase(0, 3);
    if (line.find_first_not_of(" \t\r") == std::string::npos) line = nextLine("the counts of vertices and faces");
    std::istringstream counts = plainStream(line);
    std::size_t vertices = 0, faces = 0;
    if (!(counts >> vertices >> faces)) fail("expected the counts of vertices and faces, found '" + line + "'");
    OffMesh mesh;
    for (std::size_t i = 0; i < vertices; ++i) mesh.vertices.push_back(vertex(i, vertices));
    for (std::size_t i = 0; i < faces; ++i) addFace(i, faces, mesh);
    return mesh;
  }

private:
  [[noreturn]] void fail(const std::string& message) const {
    throw Error(ErrorCode::bad_file, path_ + ":" + std::to_string(number_) + ": " + message);
  }

  /// The next line with something on it besides a comment.
  std::string nextLine(const std::string& expected) {
    std::string line;
    while (std::getline(text_, line)) {
      ++number_;
      line.erase(std::min(line.find('#'), line.size()));
      const std::size_t begin = line.find_first_not_of(" \t\r");
      if (begin != std::string::npos) return line.substr(begin);
    }
    fail("the file ends where " + expected + " should be: it is truncated");
  }

  Eigen::Vector3f vertex(std::size_t i, std::size_t count) {
    const std::string what = "vertex " + std::to_string(i + 1) + " of " + std::to_string(count);
    std::istringstream line = plainStream(nextLine(what));
    Eigen::Vector3f v;
    if (!(line >> v.x() >> v.y() >> v.z()) || !v.allFinite()) fail(what + " must be three finite numbers");
    return v;
  }

  void addFace(std::size_t i, std::size_t count, OffMesh& mesh) {
    const std::string what = "face " + std::to_string(i + 1) + " of " + std::to_string(count);
    std::istringstream line = plainStream(nextLine(what));
    std::size_t corners = 0;
    if (!(line >> corners)) fail(what + " must begin with its number of vertices");
    std::vector<std::uint32_t> corner;
    for (std::size_t k = 0; k < corners; ++k) {
      std::uint32_t index = 0;
      if (!(line >> index)) fail(what + " names fewer vertices than the " + std::to_string(corners) + " it has");
      if (index >= mesh.vertices.size()) fail(what + " names vertex " + std::to_string(index) + ", which is not there");
      corner.push_back(index);
      if (k >= 2) mesh.triangles.push_back({corner[0], corner[k - 1], corner[k]});
    }
  }

  std::string path_;
  std::istringstream text_;
  std::size_t number_ = 0;
};

}  // namespace

OffMesh readOff(const std::string& path) {
  return OffReader(path).read();
}

}  // namespace sks::tools
