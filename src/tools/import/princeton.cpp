// SPDX-License-Identifier: BSD-3-Clause
// Princeton Shape Benchmark: classification/v1/<name>/{train,test}.cla name the classes of the models in
// db/<id / 100>/m<id>/m<id>.off.
#include <sstream>

#include <sks_detector/error.hpp>

#include "io/file.hpp"
#include "io/number_text.hpp"
#include "tools/import/importer.hpp"
#include "tools/import/off_mesh.hpp"

namespace sks::tools {
namespace {

namespace fs = std::filesystem;

struct ClassifiedModel {
  std::string object;
  std::string id;
};

/// Models with the class that they stand in; classes without models only group others.
std::vector<ClassifiedModel> readClasses(const fs::path& path) {
  std::istringstream text = plainStream(readTextFile(path.string()));
  const auto fail = [&](const std::string& message) {
    throw Error(ErrorCode::bad_file, path.string() + ": " + message);
  };
  std::string magic;
  int version = 0;
  std::size_t classes = 0, count = 0;
  if (!(text >> magic >> version >> classes >> count) || magic != "PSB") {
    fail("it must begin with 'PSB 1' and the counts of classes and models");
  }
  std::vector<ClassifiedModel> models;
  for (std::size_t i = 0; i < classes; ++i) {
    std::string name, parent;
    std::size_t members = 0;
    if (!(text >> name >> parent >> members)) {
      fail("class " + std::to_string(i + 1) + " of " + std::to_string(classes) +
           " needs a name, a parent and a count of models");
    }
    for (std::size_t k = 0; k < members; ++k) {
      std::string id;
      if (!(text >> id)) fail("it ends within class '" + name + "': it is truncated");
      models.push_back({name, id});
    }
  }
  if (models.size() != count) {
    fail("it announces " + std::to_string(count) + " models but lists " + std::to_string(models.size()));
  }
  return models;
}

fs::path findClasses(const ImportOptions& options, const std::string& file) {
  std::string found;
  for (const fs::path& path : filesBelow(options.folder, ".cla")) {
    if (path.filename() != file) continue;
    if (path.parent_path().filename() == options.classification) return path;
    found += " " + path.parent_path().filename().string();
  }
  throw Error(ErrorCode::bad_file, "'" + options.folder + "' has no " + options.classification + "/" + file +
                                       (found.empty() ? ": it is not the Princeton Shape Benchmark"
                                                      : "; --classification can be one of" + found));
}

fs::path findDatabase(const std::string& folder) {
  for (const char* place : {"db", "benchmark/db", "../db"}) {
    if (fs::is_directory(fs::path(folder) / place)) return fs::path(folder) / place;
  }
  throw Error(ErrorCode::bad_file, "'" + folder + "' has no folder db with the models");
}

std::string sampled(const ImportContext& context, const fs::path& database, const std::string& id) {
  const std::string group = id.size() > 2 ? id.substr(0, id.size() - 2) : "0";  // id / 100
  const fs::path path = database / group / ("m" + id) / ("m" + id + ".off");
  const ImportOptions& options = context.options();
  return context.writeCloud("m" + id, sampleMesh(readOff(path.string()), options.points, options.diagonal));
}

}  // namespace

ImportedSet importPrinceton(const ImportContext& context) {
  const auto training = readClasses(findClasses(context.options(), "train.cla"));
  const auto tests = readClasses(findClasses(context.options(), "test.cla"));
  const fs::path database = findDatabase(context.options().folder);
  ImportedSet set;
  const std::size_t total = training.size() + tests.size();
  const auto next = [&](const ClassifiedModel& model) {
    const std::size_t done = set.data_set.training.size() + set.data_set.tests.size();
    report(context.progress(), {"sampling", "m" + model.id, done, total});
    return sampled(context, database, model.id);
  };
  for (const ClassifiedModel& model : training) {
    set.data_set.training.push_back(trainingEntry(model.object, next(model), ViewKind::model));
  }
  for (const ClassifiedModel& model : tests) set.data_set.tests.push_back({model.object, next(model)});
  report(context.progress(), {"sampling", "", total, total});
  return set;
}

}  // namespace sks::tools
