// SPDX-License-Identifier: BSD-3-Clause
#include "io/captured_views.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include <sks_detector/cloud_io.hpp>
#include <sks_detector/error.hpp>

#include "io/confined_path.hpp"
#include "io/file.hpp"
#include "io/file_lock.hpp"
#include "io/yaml_text.hpp"

namespace sks {
namespace {

namespace fs = std::filesystem;

constexpr const char* heading =
    "# Captured training views, one a line. Lines may be deleted while no detector runs; the clouds they name at any "
    "time.\n";

/// `000.pcd`, or the name after the last one: a number is not used again while a later file stands there.
std::string nextName(const fs::path& folder) {
  long next = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".pcd") continue;
    next = std::max(next, std::strtol(entry.path().stem().c_str(), nullptr, 10) + 1);
  }
  char name[32];
  std::snprintf(name, sizeof(name), "%03ld.pcd", next);
  return name;
}

/// The data set file as it stands, so that what is not ours to know stays as it is.
YAML::Node loadFile(const std::string& file) {
  const std::string text = fs::exists(file) ? readTextFile(file) : "{name: captured, units: m}";
  return parseYaml(text, file);
}

/// With a line for each entry, whatever the file looked like before, so that people can take one out.
void storeFile(const std::string& file, YAML::Node root) {
  root.SetStyle(YAML::EmitterStyle::Block);
  if (YAML::Node training = root["training"]) {
    training.SetStyle(YAML::EmitterStyle::Block);
    for (YAML::Node entry : training) entry.SetStyle(YAML::EmitterStyle::Flow);
  }
  YAML::Emitter emitter;
  emitter << root;
  writeFileAtomically(file, std::string(heading) + emitter.c_str() + "\n");
}

}  // namespace

CapturedViews::CapturedViews(std::string folder)
    : folder_(std::move(folder)),
      file_((fs::path(folder_) / "dataset.yaml").string()),
      lock_file_((fs::path(folder_) / ".lock").string()) {}

CapturedViews::Added CapturedViews::add(const std::string& object, const Cloud& view,
                                        const std::optional<Eigen::Hyperplane<double, 3>>& plane,
                                        const std::optional<Eigen::Isometry3d>& T_fixed_view) {
  checkFileName(object, "the object's name");
  if (object.rfind("builtin:", 0) == 0) {
    throw Error(ErrorCode::bad_usage, "the object's name '" + object + "' is refused: it starts with 'builtin:'");
  }
  makeFolder(folder_);
  const std::lock_guard<std::mutex> lock(mutex_);
  const FileLock among_processes(lock_file_);
  const DataSet before = readUnlocked();
  if (before.scale != 1) {
    throw Error(ErrorCode::bad_usage, file_ +
                                          " is in millimetres, but captured views are in metres: move it and its "
                                          "clouds to a folder of their own");
  }
  const std::string folder = objectFolder(object);
  makeFolder(folder);
  const std::string name = nextName(folder);
  Added added{(fs::path(folder) / name).string(),
              1 + std::size_t(std::count_if(before.training.begin(), before.training.end(),
                                            [&](const TrainingEntry& entry) { return entry.object == object; }))};
  writeCloud(added.file, view);

  YAML::Node root = loadFile(file_), entry;
  entry["object"] = object;
  entry["cloud"] = object + "/" + name;
  entry["kind"] = "view";
  if (plane) {
    for (int i = 0; i < 4; ++i) entry["plane"].push_back(plane->coeffs()[i]);
  }
  if (T_fixed_view) {
    for (int i = 0; i < 16; ++i) entry["cloud_pose"].push_back((*T_fixed_view)(i / 4, i % 4));
  }
  root["training"].push_back(entry);
  try {
    storeFile(file_, root);
  } catch (...) {
    std::error_code ignored;
    fs::remove(added.file, ignored);  // no view without an entry
    throw;
  }
  return added;
}

std::size_t CapturedViews::remove(const std::string& object) {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::error_code ignored;
  if (!fs::exists(file_, ignored)) return 0;
  const FileLock among_processes(lock_file_);
  const DataSet before = readUnlocked();
  std::vector<std::string> removed;
  for (const auto* entries : {&before.training, &before.missing}) {
    for (const TrainingEntry& entry : *entries) {
      if (entry.object == object) removed.push_back(entry.path);
    }
  }
  if (removed.empty()) return 0;
  checkFileName(object, "the object's name");

  YAML::Node root = loadFile(file_), rest(YAML::NodeType::Sequence);
  for (const YAML::Node& entry : root["training"]) {
    if (entry["object"].Scalar() != object) rest.push_back(entry);
  }
  root["training"] = rest;
  if (rest.size() == 0 && !root["scenes"] && !root["tests"]) {
    fs::remove(file_, ignored);  // a data set must not be empty
  } else {
    storeFile(file_, root);
  }
  const fs::path folder = objectFolder(object);
  for (const std::string& cloud : removed) {
    if (fs::path(cloud).parent_path() == folder) fs::remove(cloud, ignored);
  }
  fs::remove(folder, ignored);  // fails, as it should, if something is left in it
  return removed.size();
}

CapturedViews::Removed CapturedViews::removeLast(const std::string& object) {
  checkFileName(object, "the object's name");
  const auto none = [&] { return Error(ErrorCode::bad_usage, "no view of '" + object + "' was captured"); };
  const std::lock_guard<std::mutex> lock(mutex_);
  std::error_code ignored;
  if (!fs::exists(file_, ignored)) throw none();
  const FileLock among_processes(lock_file_);
  YAML::Node root = loadFile(file_), rest(YAML::NodeType::Sequence);
  std::size_t views = 0, index = 0, last = 0;
  std::string cloud;
  for (const YAML::Node& entry : root["training"]) {
    if (entry["object"].Scalar() == object) {
      ++views;
      last = index;
      cloud = entry["cloud"].Scalar();
    }
    ++index;
  }
  if (views == 0) throw none();
  index = 0;
  for (const YAML::Node& entry : root["training"]) {
    if (index++ != last) rest.push_back(entry);
  }
  root["training"] = rest;
  if (rest.size() == 0 && !root["scenes"] && !root["tests"]) {
    fs::remove(file_, ignored);  // a data set must not be empty
  } else {
    storeFile(file_, root);
  }
  Removed removed{(fs::path(folder_) / cloud).lexically_normal().string(), views - 1};
  if (fs::path(removed.file).parent_path() == objectFolder(object)) fs::remove(removed.file, ignored);
  return removed;
}

DataSet CapturedViews::read() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return readUnlocked();
}

DataSet CapturedViews::readUnlocked() const {
  if (std::error_code ignored; fs::exists(file_, ignored)) return loadDataSet(file_, MissingClouds::left_out);
  DataSet empty;
  empty.file = file_;
  empty.name = "captured";
  return empty;
}

std::vector<std::string> CapturedViews::objects() const {
  std::vector<std::string> names;
  for (const TrainingEntry& entry : read().training) {
    if (std::find(names.begin(), names.end(), entry.object) == names.end()) names.push_back(entry.object);
  }
  return names;
}

/// A link that someone put there must not lead out of the folder.
std::string CapturedViews::objectFolder(const std::string& object) const {
  return fs::path(confinedPath(object + "/.view", folder_)).parent_path().string();
}

}  // namespace sks
