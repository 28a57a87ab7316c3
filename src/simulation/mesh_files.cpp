// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/mesh_files.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <vector>

#include <sks_detector/error.hpp>

#include "io/confined_path.hpp"
#include "io/regular_file.hpp"

namespace sks {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t largest_mesh_file = std::size_t(2) << 30;       // [bytes]
constexpr std::size_t largest_material_file = std::size_t(64) << 20;  // [bytes]

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

/// Slashes instead of backslashes, and nothing around the name.
std::string plainName(const std::string& name) {
  std::string plain = name;
  std::replace(plain.begin(), plain.end(), '\\', '/');
  const auto outside = [](unsigned char c) { return std::isspace(c) != 0 || c == '"'; };
  while (!plain.empty() && outside(plain.back())) plain.pop_back();
  while (!plain.empty() && outside(plain.front())) plain.erase(0, 1);
  for (const char* scheme : {"file://", "file:"}) {
    if (lowerCase(plain).rfind(scheme, 0) == 0) plain.erase(0, std::string(scheme).size());
  }
  return plain;
}

/// %20 and the like, as COLLADA and glTF write names.
std::string decoded(const std::string& name) {
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool code = name[i] == '%' && i + 2 < name.size() && std::isxdigit(static_cast<unsigned char>(name[i + 1])) &&
                      std::isxdigit(static_cast<unsigned char>(name[i + 2]));
    text += code ? char(std::stoi(name.substr(i + 1, 2), nullptr, 16)) : name[i];
    if (code) i += 2;
  }
  return text;
}

/// The file of a folder whose name differs in capitals only; empty if there is none. Of several the first by name.
fs::path inOtherCapitals(const fs::path& path) {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator file(path.parent_path(), error), end; !error && file != end; file.increment(error)) {
    if (lowerCase(file->path().filename().string()) == lowerCase(path.filename().string())) found.push_back(*file);
  }
  return found.empty() ? fs::path() : *std::min_element(found.begin(), found.end());
}

std::string contentOf(const std::string& path, std::size_t largest) {
  const RegularFile file(path);
  if (file.size() > largest) {
    throw Error(ErrorCode::bad_file, "it is larger than " + std::to_string(largest >> 20) + " MB");
  }
  std::string content(file.size(), '\0');
  content.resize(file.read(content.data(), content.size(), 0));
  return content;
}

}  // namespace

std::string MeshFiles::ending() const {
  return lowerCase(fs::path(mesh_).extension().string());
}

std::string MeshFiles::allowed(const std::string& path) const {
  return folder_.empty() ? path : confinedPath(fs::absolute(path).string(), folder_);
}

std::string MeshFiles::find(const std::string& name, const std::string& from) const {
  const std::string plain = plainName(name);
  std::string reason = "it does not exist";
  if (plain.empty() || plain.find('\0') != std::string::npos) throw Error(ErrorCode::bad_file, "it has no name");
  std::vector<fs::path> candidates;
  for (const std::string& spelling : {plain, decoded(plain)}) {
    for (const std::string& base : {from.empty() ? mesh_ : from, mesh_}) {
      const fs::path folder = fs::path(base).parent_path(), beside = folder / fs::path(spelling).filename();
      candidates.insert(candidates.end(), {folder / spelling, beside, inOtherCapitals(beside)});
    }
  }
  for (const fs::path& candidate : candidates) {
    if (!candidate.has_filename()) continue;
    try {
      std::string file = allowed(candidate.lexically_normal().string());
      std::error_code ignored;
      if (fs::exists(file, ignored)) return file;
    } catch (const Error& error) {
      reason = error.what();
    }
  }
  throw Error(ErrorCode::bad_file, reason);
}

std::string MeshFiles::read(const std::string& path) {
  return contentOf(path, largest_material_file);
}

std::string MeshFiles::readMesh() const {
  return contentOf(mesh_, largest_mesh_file);
}

}  // namespace sks
