// SPDX-License-Identifier: BSD-3-Clause
// ModelNet10 and ModelNet40: <class>/train/*.off and <class>/test/*.off.
#include <sks_detector/error.hpp>

#include "tools/import/importer.hpp"
#include "tools/import/off_mesh.hpp"

namespace sks::tools {
namespace {

namespace fs = std::filesystem;

struct Shape {
  std::string object;
  std::string part;  ///< train or test
  fs::path path;
};

std::vector<Shape> findShapes(const std::string& folder) {
  std::vector<Shape> shapes;
  for (const fs::path& object : foldersIn(folder)) {
    for (const char* part : {"train", "test"}) {
      if (!fs::is_directory(object / part)) continue;
      for (const fs::path& path : filesIn(object / part, ".off")) {
        shapes.push_back({object.filename().string(), part, path});
      }
    }
  }
  if (shapes.empty()) {
    throw Error(ErrorCode::bad_data, "'" + folder + "' is not ModelNet: there is no <class>/train/*.off in it");
  }
  return shapes;
}

}  // namespace

ImportedSet importModelNet(const ImportContext& context) {
  const ImportOptions& options = context.options();
  ImportedSet set;
  const std::vector<Shape> shapes = findShapes(options.folder);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const Shape& shape = shapes[i];
    report(context.progress(), {"sampling", shape.path.filename().string(), i, shapes.size()});
    const Cloud cloud = sampleMesh(readOff(shape.path.string()), options.points, options.diagonal);
    const std::string path = context.writeCloud(shape.part + "/" + shape.path.stem().string(), cloud);
    if (shape.part == "train") {
      set.data_set.training.push_back(trainingEntry(shape.object, path, ViewKind::model));
    } else {
      set.data_set.tests.push_back({shape.object, path});
    }
  }
  report(context.progress(), {"sampling", "", shapes.size(), shapes.size()});
  return set;
}

}  // namespace sks::tools
