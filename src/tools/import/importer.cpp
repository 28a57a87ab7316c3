// SPDX-License-Identifier: BSD-3-Clause
#include "tools/import/importer.hpp"

#include <algorithm>
#include <cctype>

#include <sks_detector/cloud_io.hpp>
#include <sks_detector/error.hpp>

#include "io/file.hpp"

namespace sks::tools {

namespace fs = std::filesystem;

namespace {

bool hasExtension(const fs::path& path, const std::string& extension) {
  std::string own = path.extension().string();
  std::transform(own.begin(), own.end(), own.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return own == extension;
}

void sortByNumber(std::vector<fs::path>& paths) {
  std::sort(paths.begin(), paths.end(),
            [](const fs::path& a, const fs::path& b) { return beforeByNumber(a.string(), b.string()); });
}

/// What `iterator` goes through that `wanted` holds for.
template <typename Iterator, typename Predicate>
std::vector<fs::path> listed(const fs::path& folder, Predicate wanted) {
  std::vector<fs::path> paths;
  std::error_code error;
  for (Iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (wanted(*it)) paths.push_back(it->path());
  }
  if (error) throw Error(ErrorCode::bad_file, "cannot list '" + folder.string() + "': " + error.message());
  sortByNumber(paths);
  return paths;
}

}  // namespace

ImportContext::ImportContext(ImportOptions options, Progress progress)
    : options_(std::move(options)), progress_(std::move(progress)) {}

std::string ImportContext::writeCloud(const std::string& name, const Cloud& cloud) const {
  const fs::path output(options_.output);
  const fs::path path = output.parent_path() / (output.stem().string() + "_clouds") / (name + ".pcd");
  makeFolder(path.parent_path().string());
  sks::writeCloud(path.string(), cloud);
  return path.string();
}

std::vector<fs::path> foldersIn(const fs::path& folder) {
  return listed<fs::directory_iterator>(folder, [](const fs::directory_entry& e) { return e.is_directory(); });
}

std::vector<fs::path> filesIn(const fs::path& folder, const std::string& extension) {
  return listed<fs::directory_iterator>(
      folder, [&](const fs::directory_entry& e) { return e.is_regular_file() && hasExtension(e.path(), extension); });
}

std::vector<fs::path> filesBelow(const fs::path& folder, const std::string& extension) {
  return listed<fs::recursive_directory_iterator>(
      folder, [&](const fs::directory_entry& e) { return e.is_regular_file() && hasExtension(e.path(), extension); });
}

bool beforeByNumber(const std::string& a, const std::string& b) {
  std::size_t i = 0, j = 0;
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  while (i < a.size() && j < b.size()) {
    if (!digit(a[i]) || !digit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
      continue;
    }
    const auto number = [&](const std::string& text, std::size_t& at) {  // its digits without leading zeros
      while (at < text.size() && text[at] == '0') ++at;
      const std::size_t begin = at;
      while (at < text.size() && digit(text[at])) ++at;
      return text.substr(begin, at - begin);
    };
    const std::string first = number(a, i), second = number(b, j);
    if (first.size() != second.size()) return first.size() < second.size();
    if (first != second) return first < second;
  }
  if (a.size() - i != b.size() - j) return a.size() - i < b.size() - j;
  return a < b;
}

TrainingEntry trainingEntry(const std::string& object, const fs::path& path, ViewKind kind) {
  TrainingEntry entry;
  entry.object = object;
  entry.path = path.string();
  entry.kind = kind;
  return entry;
}

}  // namespace sks::tools
