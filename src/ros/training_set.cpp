// SPDX-License-Identifier: BSD-3-Clause
#include "ros/training_set.hpp"

#include <algorithm>
#include <functional>
#include <map>

#include <sks_detector/cloud_io.hpp>
#include <sks_detector/error.hpp>

#include "io/confined_path.hpp"

namespace sks_detector {
namespace {

using sks::Error;
using sks::ErrorCode;

/// A file that lies inside must not reach out by what it names.
void checkConfined(const sks::DataSet& data_set, const std::string& directory) {
  for (const sks::TrainingEntry& entry : data_set.training) {
    const bool builtin = entry.mesh && entry.path == entry.source && entry.path.rfind("builtin:", 0) == 0;
    if (builtin) continue;
    try {
      sks::confinedPath(entry.path, directory);
    } catch (const Error& error) {
      throw Error(error.code(), data_set.file + ": a cloud of object '" + entry.object + "': " + error.what());
    }
  }
}

/// What was captured and is damaged now does not keep the rest from being trained.
void leaveOutUnreadable(sks::DataSet& views) {
  const auto unreadable = [&](const sks::TrainingEntry& entry) {
    if (entry.mesh) return false;
    try {
      sks::readCloud(entry.path, views.scale);
      return false;
    } catch (const Error& error) {
      views.warnings.push_back("a captured view of '" + entry.object + "' is left out: " + error.what());
      return true;
    }
  };
  const auto rest = std::stable_partition(views.training.begin(), views.training.end(), std::not_fn(unreadable));
  views.missing.insert(views.missing.end(), rest, views.training.end());
  views.training.erase(rest, views.training.end());
}

/// As captured by releases that did not store planes.
std::vector<std::string> objectsWithoutPlanes(const sks::DataSet& views) {
  std::map<std::string, std::size_t> count;
  for (const sks::TrainingEntry& entry : views.training) ++count[entry.object];
  for (const sks::TrainingEntry& entry : views.training) {
    if (entry.plane) count.erase(entry.object);
  }
  std::vector<std::string> objects;
  for (const auto& [object, number] : count) {
    if (number > 1) objects.push_back(object);
  }
  return objects;
}

void add(sks::DataSet data_set, const std::string& prefix, const std::string& directory,
         const sks::MeshSampler& sampler, TrainingSet& set) {
  checkConfined(data_set, directory);
  for (sks::TrainingEntry& entry : data_set.training) entry.source = prefix + entry.source;
  const std::vector<sks::TrainingSample> samples = sks::trainingSamples(data_set, sampler);
  set.samples.insert(set.samples.end(), samples.begin(), samples.end());
  set.warnings.insert(set.warnings.end(), data_set.warnings.begin(), data_set.warnings.end());
}

}  // namespace

TrainingSet gatherTrainingSet(const std::string& dataset, bool captured, const sks::CapturedViews& views,
                              const std::string& directory, const sks::MeshSampler& sampler) {
  TrainingSet set;
  if (!dataset.empty()) {
    const sks::DataSet data_set = sks::loadDataSet(sks::confinedPath(dataset, directory));
    set.name = data_set.name;
    add(data_set, "", directory, sampler, set);
    if (set.samples.empty()) {
      throw Error(ErrorCode::bad_data, "'" + data_set.file + "' has no training clouds; list them under 'training'");
    }
  }
  if (captured || dataset.empty()) {
    sks::DataSet data_set = views.read();
    if (set.name.empty()) set.name = data_set.name;
    checkConfined(data_set, directory);
    leaveOutUnreadable(data_set);
    set.without_planes = objectsWithoutPlanes(data_set);
    add(data_set, dataset.empty() ? "" : "captured/", directory, sampler, set);
    if (set.samples.empty() && !data_set.missing.empty()) {
      throw Error(ErrorCode::bad_usage, "there is nothing to train: no captured view can be used; " +
                                            data_set.warnings.front() + "; capture views again (~capture_view)");
    }
    if (set.samples.empty()) {
      throw Error(ErrorCode::bad_usage,
                  "there is nothing to train: no view was captured yet (~capture_view), and no data set is given");
    }
  }
  return set;
}

}  // namespace sks_detector
