// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>

#include "tools/data_set_yaml.hpp"
#include "tools/import/importer.hpp"

namespace sks::tools {
namespace {

namespace fs = std::filesystem;

std::string symmetryText(const Symmetry& symmetry) {
  return ", symmetry: {axis: " + yamlList({symmetry.axis.x(), symmetry.axis.y(), symmetry.axis.z()}) +
         ", order: " + (symmetry.order == 0 ? "inf" : std::to_string(symmetry.order)) + "}";
}

}  // namespace

std::string dataSetYaml(const ImportedSet& set, const std::string& output) {
  const fs::path folder = fs::absolute(output).parent_path();
  const auto relative = [&](const std::string& path) { return fs::proximate(fs::absolute(path), folder).string(); };
  const DataSet& data = set.data_set;
  std::string text = "# Written by sks import.\nname: " + yamlText(data.name) + "\nunits: " + set.units + "\n";
  if (!data.scenes.empty()) text += "max_distance: " + std::string(set.units == "mm" ? "50" : "0.05") + "\n";
  if (!data.training.empty()) text += "training:\n";
  for (const TrainingEntry& entry : data.training) {
    const char* kind = entry.mesh ? "mesh" : entry.kind == ViewKind::model ? "model" : "view";
    text += "  - {object: " + yamlText(entry.object) + ", cloud: " + yamlText(relative(entry.path)) +
            ", kind: " + kind + (entry.symmetry ? symmetryText(*entry.symmetry) : "") + "}\n";
  }
  if (!data.scenes.empty()) text += "scenes:\n";
  for (Scene scene : data.scenes) {
    scene.path = relative(scene.path);
    for (GroundTruth& truth : scene.objects) {
      if (!truth.reference.empty()) truth.reference = relative(truth.reference);
    }
    text += sceneYaml(scene);
  }
  if (!data.tests.empty()) text += "tests:\n";
  for (const TestEntry& test : data.tests) {
    text += "  - {object: " + yamlText(test.object) + ", cloud: " + yamlText(relative(test.path)) + "}\n";
  }
  return text;
}

}  // namespace sks::tools
