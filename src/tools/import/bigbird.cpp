// SPDX-License-Identifier: BSD-3-Clause
// BigBIRD: <object>/clouds/NP<camera>_<angle>.pcd, the object's points alone. Instances are recognised: every second
// turn of the table is tested and the others are trained.
#include <map>

#include <sks_detector/error.hpp>

#include "tools/import/importer.hpp"

namespace sks::tools {
namespace {

namespace fs = std::filesystem;

/// The turn of the table [degrees] that a cloud's name tells; empty for other files.
std::string angleOf(const fs::path& path) {
  const std::string stem = path.stem().string();
  const std::size_t bar = stem.rfind('_');
  if (stem.compare(0, 2, "NP") != 0 || bar == std::string::npos) return "";
  const std::string angle = stem.substr(bar + 1);
  return angle.find_first_not_of("0123456789") == std::string::npos ? angle : "";
}

}  // namespace

ImportedSet importBigBird(const ImportContext& context) {
  const ImportOptions& options = context.options();
  const std::size_t step = std::size_t(options.every > 0 ? options.every : 1);
  ImportedSet set;
  const std::vector<fs::path> objects = foldersIn(options.folder);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const std::string object = objects[i].filename().string();
    report(context.progress(), {"listing", object, i, objects.size()});
    if (!fs::is_directory(objects[i] / "clouds")) continue;
    std::map<int, std::vector<fs::path>> turns;
    for (const fs::path& path : filesIn(objects[i] / "clouds", ".pcd")) {
      const std::string angle = angleOf(path);
      if (!angle.empty() && angle.size() < 9) turns[std::stoi(angle)].push_back(path);
    }
    std::size_t turn = 0;
    for (const auto& [angle, paths] : turns) {
      const std::size_t number = turn++;
      if (number % step != 0) continue;
      for (const fs::path& path : paths) {
        if (number / step % 2 == 0) {
          set.data_set.training.push_back(trainingEntry(object, path, ViewKind::view));
        } else {
          set.data_set.tests.push_back({object, path.string()});
        }
      }
    }
  }
  report(context.progress(), {"listing", "", objects.size(), objects.size()});
  if (set.data_set.training.empty()) {
    throw Error(ErrorCode::bad_data,
                "'" + options.folder + "' is not BigBIRD: there is no <object>/clouds/NP<camera>_<angle>.pcd in it");
  }
  return set;
}

}  // namespace sks::tools
