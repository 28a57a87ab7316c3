// SPDX-License-Identifier: BSD-3-Clause
// STL, whose text is written in many ways that its first definition does not know.
#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <string_view>
#include <unordered_map>

#include <sks_detector/error.hpp>

#include "io/number_text.hpp"
#include "simulation/file_mesh.hpp"

namespace sks {
namespace {

constexpr std::size_t stl_header_size = 84, stl_facet_size = 50;  // of a binary file [bytes]

[[noreturn]] void badStl(const std::string& message) {
  throw Error(ErrorCode::bad_data, message);
}

std::uint32_t wordAt(const std::string& content, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(content[offset + i]);
  return value;
}

/// Corners that lie at one position are one vertex: STL repeats it for each face.
class StlVertices {
public:
  explicit StlVertices(FileMesh& mesh) : mesh_(mesh) {}

  void addCorner(const std::array<float, 3>& position) {
    const auto [found, is_new] = known_.try_emplace(position, std::uint32_t(mesh_.vertices.size()));
    if (is_new) mesh_.vertices.emplace_back(position[0], position[1], position[2]);
    mesh_.corners.push_back({found->second, -1});
  }

private:
  struct Hash {
    std::size_t operator()(const std::array<float, 3>& position) const {
      std::size_t hash = 0;
      for (const float value : position) {
        std::uint32_t bits;
        std::memcpy(&bits, &value, sizeof(bits));
        hash = (hash ^ bits) * 0x9e3779b97f4a7c15;
        hash ^= hash >> 29;
      }
      return hash;
    }
  };
  /// By their bits, so that a position that is no number is one, too.
  struct Same {
    bool operator()(const std::array<float, 3>& a, const std::array<float, 3>& b) const {
      return std::memcmp(a.data(), b.data(), sizeof(a)) == 0;
    }
  };

  FileMesh& mesh_;
  std::unordered_map<std::array<float, 3>, std::uint32_t, Hash, Same> known_;
};

FileMesh readBinary(const std::string& content) {
  const std::size_t facets = wordAt(content, 80);
  if (content.size() < stl_header_size + facets * stl_facet_size) {
    badStl("it is cut off: it says " + std::to_string(facets) + " triangles, but holds " +
           std::to_string((content.size() - stl_header_size) / stl_facet_size));
  }
  FileMesh mesh;
  StlVertices vertices(mesh);
  for (std::size_t i = 0; i < facets; ++i) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      std::array<float, 3> position;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::uint32_t bits = wordAt(content, stl_header_size + i * stl_facet_size + 12 * (corner + 1) + 4 * axis);
        std::memcpy(&position[axis], &bits, sizeof(bits));
      }
      vertices.addCorner(position);
    }
    mesh.endFace(-1, false);
  }
  return mesh;
}

/// Words of the text, in small letters.
class StlWords {
public:
  explicit StlWords(const std::string& content) : rest_(content) {}

  bool next(std::string& word) {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r\n\f\v"), rest_.size()));
    const std::string_view text = rest_.substr(0, rest_.find_first_of(" \t\r\n\f\v"));
    rest_.remove_prefix(text.size());
    word.assign(text);
    std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return !word.empty();
  }
  /// The name of a solid may be any text.
  void skipLine() { rest_.remove_prefix(std::min(rest_.find_first_of("\r\n"), rest_.size())); }

private:
  std::string_view rest_;
};

FileMesh readText(const std::string& content) {
  FileMesh mesh;
  StlVertices vertices(mesh);
  StlWords words(content);
  bool in_loop = false, ended = false;
  for (std::string word; words.next(word);) {
    if (word == "solid" || word == "endsolid") {
      ended = word == "endsolid";
      words.skipLine();
    } else if (word == "vertex") {
      std::array<float, 3> position{};
      for (float& value : position) {
        double number = 0;
        if (!words.next(word)) badStl("it is cut off within a vertex");
        if (!parseNumber(word, number)) badStl("a vertex holds '" + word.substr(0, 40) + "', no number");
        value = float(number) + 0.0f;  // without a sign of zero
      }
      vertices.addCorner(position);
      in_loop = true;
    } else if (word == "facet" || word == "endloop" || word == "endfacet") {
      if (in_loop) mesh.endFace(-1, false);
      in_loop = false;
    }
  }
  if (in_loop) badStl("it is cut off within a face");
  if (!ended) mesh.warnings.emplace_back("it does not end with 'endsolid': a part of it may be missing");
  return mesh;
}

/// Whether the text of an STL file begins here. Headers of binary files may begin with "solid", too.
bool isText(const std::string& content) {
  StlWords words(content);
  std::string word;
  if (!words.next(word)) return false;
  if (word.rfind("\xef\xbb\xbf", 0) == 0) word.erase(0, 3);  // the mark of UTF-8
  return word == "solid" && content.find('\0') == std::string::npos;
}

}  // namespace

FileMesh readStlMesh(const std::string& content) {
  const bool sized = content.size() >= stl_header_size;
  if (sized && content.size() == stl_header_size + wordAt(content, 80) * stl_facet_size) return readBinary(content);
  if (isText(content)) return readText(content);
  if (!sized) badStl("it is neither a text nor a binary STL file");
  return readBinary(content);
}

}  // namespace sks
