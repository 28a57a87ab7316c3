// SPDX-License-Identifier: BSD-3-Clause
#include "ros/folders.hpp"

#include <cstdlib>
#include <filesystem>

#include "io/file.hpp"

namespace sks_detector {
namespace {

namespace fs = std::filesystem;

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

/// Where nodes of ROS keep their files.
fs::path rosHome() {
  const std::string home = environment("ROS_HOME");
  return home.empty() ? fs::path(environment("HOME")) / ".ros" : fs::path(home);
}

/// `~/` is taken to be the home folder: launch files have no shell.
std::string absolute(const std::string& path) {
  const bool home = path == "~" || path.rfind("~/", 0) == 0;
  return fs::absolute(home ? environment("HOME") + path.substr(1) : path).string();
}

}  // namespace

std::string codebookFile(const NodeSettings& settings) {
  return settings.codebook.empty() ? "" : absolute(settings.codebook);
}

std::string codebookDirectory(const NodeSettings& settings) {
  if (!settings.codebook_directory.empty()) return absolute(settings.codebook_directory);
  if (settings.codebook.empty()) return (rosHome() / "sks_detector").string();
  return fs::path(codebookFile(settings)).parent_path().string();
}

std::string datasetDirectory(const NodeSettings& settings) {
  if (!settings.dataset_directory.empty()) return absolute(settings.dataset_directory);
  return (rosHome() / "sks_detector" / "datasets").string();
}

void makeFolderOf(const std::string& file) {
  sks::makeFolder(fs::path(file).parent_path().string());
}

}  // namespace sks_detector
