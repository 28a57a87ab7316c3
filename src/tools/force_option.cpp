// SPDX-License-Identifier: BSD-3-Clause
#include "tools/force_option.hpp"

#include <filesystem>
#include <system_error>

#include <sks_detector/codebook_file.hpp>
#include <sks_detector/error.hpp>

#include "io/file.hpp"

namespace sks::tools {
namespace {

namespace fs = std::filesystem;

bool isThere(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(path, ignored));
}

bool holdsFiles(const fs::path& folder) {
  std::error_code ignored;
  return fs::directory_iterator(folder, ignored) != fs::directory_iterator();
}

void removeFile(const fs::path& file) {
  std::error_code ignored;
  if (fs::is_regular_file(file, ignored)) fs::remove(file, ignored);
}

}  // namespace

void ForceOption::add(CLI::App& command) {
  command.add_flag("--force", force_, "write also where a data set is: files of the same names are replaced");
}

void ForceOption::addForCodebook(CLI::App& command) {
  command.add_flag("--force", force_, "replace a codebook that is there");
}

void ForceOption::checkFolder(const std::string& folder) const {
  const fs::path file = fs::path(folder) / "dataset.yaml";
  if (isThere(file)) refuse(folder, "holds a data set already (dataset.yaml)");
  if (holdsFiles(fs::path(folder) / "scenes")) refuse(folder, "holds clouds already (scenes/)");
  removeFile(file);
}

void ForceOption::checkFile(const std::string& file) const {
  std::error_code ignored;
  if (fs::is_regular_file(file, ignored)) refuse(file, "is there already");
}

void ForceOption::write(const std::string& file, const std::string& text) const {
  if (force_) {
    writeFileAtomically(file, text);
  } else if (!writeNewFileAtomically(file, text)) {
    refuse(file, "is there already");
  }
}

void ForceOption::write(const std::string& file, const Codebook& codebook) const {
  if (force_) {
    writeCodebook(file, codebook);
  } else if (!writeNewCodebook(file, codebook)) {
    refuse(file, "is there already");
  }
}

void ForceOption::refuse(const std::string& path, const std::string& what) const {
  if (force_) return;
  throw Error(ErrorCode::bad_usage,
              "--output: '" + path + "' " + what + ": give another one, or --force to write there all the same");
}

}  // namespace sks::tools
