// SPDX-License-Identifier: BSD-3-Clause
#include "io/confined_path.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include <sks_detector/error.hpp>

#include "core/settings/shown_text.hpp"
#include "core/settings/utf8.hpp"

namespace sks {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_path = 4095;  // what Linux takes
constexpr std::size_t longest_file_name = 100;

std::string quoted(const std::string& text) {
  return "'" + shown(text) + "'";
}

/// Resolves every link of what exists; the rest is taken as it stands. A link to nothing counts as nothing here, so
/// that it would be written through later: it is refused.
fs::path resolved(const fs::path& path) {
  fs::path result = fs::weakly_canonical(fs::absolute(path));
  fs::path part;
  for (const fs::path& name : result) {
    part /= name;
    if (fs::is_symlink(fs::symlink_status(part))) {
      throw fs::filesystem_error("a link to nothing", part, std::make_error_code(std::errc::no_such_file_or_directory));
    }
  }
  return result;
}

/// Whether a path is the directory or lies in it.
bool inside(const fs::path& path, const fs::path& directory) {
  const auto end = std::mismatch(directory.begin(), directory.end(), path.begin(), path.end()).first;
  return end == directory.end() || end->empty();  // a trailing slash makes an empty last part
}

}  // namespace

std::string confinedPath(const std::string& path, const std::string& directory) {
  const auto refuse = [&](const std::string& reason) {
    throw Error(ErrorCode::bad_usage, "the path " + quoted(path) + " is refused: " + reason +
                                          "; give the name of a file in " + quoted(directory) +
                                          ", relative to it or absolute");
  };
  if (directory.empty())
    throw Error(ErrorCode::bad_usage, "the path " + quoted(path) + " is refused: no folder is set");
  if (path.empty()) refuse("it is empty");
  if (path.size() > longest_path) refuse("it has " + std::to_string(path.size()) + " bytes, which is too long");
  if (path.find('\0') != std::string::npos) refuse("it contains a null character");
  if (path[0] == '~') refuse("'~' is not expanded");
  try {
    const fs::path folder = resolved(directory), file = resolved(fs::path(directory) / path);
    if (!inside(file, folder)) refuse("it leads to " + quoted(file.string()) + ", outside of the allowed folder");
    if (!file.has_filename() || fs::is_directory(file)) refuse("it names a folder");
    return file.string();
  } catch (const fs::filesystem_error& error) {
    refuse(error.code().message() + (error.path1().empty() ? "" : " (" + quoted(error.path1().string()) + ")"));
  }
  return {};
}

void checkFileName(const std::string& name, const std::string& what) {
  const auto refuse = [&](const std::string& reason) {
    throw Error(ErrorCode::bad_usage, what + " " + quoted(name) + " is refused: " + reason);
  };
  if (name.empty()) refuse("it is empty");
  if (name.size() > longest_file_name) refuse("it is longer than " + std::to_string(longest_file_name) + " bytes");
  if (name[0] == '.') refuse("it starts with a dot");
  if (name.find('/') != std::string::npos || name.find('\\') != std::string::npos) refuse("it contains a slash");
  if (hasControl(name)) refuse("it contains a control character");
  if (!isUtf8(name)) refuse("it is not UTF-8");
}

}  // namespace sks
