// SPDX-License-Identifier: BSD-3-Clause
// Washington RGB-D Object Dataset: <category>/<category>_<instance>/<category>_<instance>_<video>_<frame>.pcd.
// Categories are classified: the last instance of each is tested and the others are trained.
#include <sks_detector/cloud_io.hpp>
#include <sks_detector/error.hpp>

#include "tools/import/importer.hpp"

namespace sks::tools {
namespace {

namespace fs = std::filesystem;

constexpr int usual_step = 5;  // the data set's own evaluation takes every fifth frame
constexpr double farthest_in_metres = 20;

/// Unit of the clouds, from how far the first one reaches.
std::string unitsOf(const fs::path& path) {
  float reach = 0;
  for (const Eigen::Vector3f& point : readCloud(path.string()).points) {
    if (point.allFinite()) reach = std::max(reach, point.norm());
  }
  return reach > farthest_in_metres ? "mm" : "m";
}

}  // namespace

ImportedSet importWashington(const ImportContext& context) {
  const ImportOptions& options = context.options();
  const std::size_t step = std::size_t(options.every > 0 ? options.every : usual_step);
  ImportedSet set;
  fs::path first;
  const std::vector<fs::path> categories = foldersIn(options.folder);
  for (std::size_t i = 0; i < categories.size(); ++i) {
    const std::string category = categories[i].filename().string();
    report(context.progress(), {"listing", category, i, categories.size()});
    const std::vector<fs::path> instances = foldersIn(categories[i]);
    for (std::size_t k = 0; k < instances.size(); ++k) {
      const std::vector<fs::path> frames = filesIn(instances[k], ".pcd");
      const bool test = instances.size() > 1 && k + 1 == instances.size();
      for (std::size_t f = 0; f < frames.size(); f += step) {
        if (first.empty()) first = frames[f];
        if (test) {
          set.data_set.tests.push_back({category, frames[f].string()});
        } else {
          set.data_set.training.push_back(trainingEntry(category, frames[f], ViewKind::view));
        }
      }
    }
  }
  report(context.progress(), {"listing", "", categories.size(), categories.size()});
  if (first.empty()) {
    throw Error(ErrorCode::bad_data, "'" + options.folder +
                                         "' is not the Washington RGB-D data set: there is no "
                                         "<category>/<category>_<instance>/*.pcd in it");
  }
  set.units = unitsOf(first);
  return set;
}

}  // namespace sks::tools
