// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>

#include "core/settings/number_format.hpp"
#include "tools/data_set_yaml.hpp"
#include "tools/import/importer.hpp"

namespace sks::tools {
namespace {

namespace fs = std::filesystem;

std::string listText(const Eigen::Vector3d& v) {
  return yamlList({v.x(), v.y(), v.z()});
}

std::string symmetryText(const Symmetry& symmetry) {
  return ", symmetry: {axis: " + listText(symmetry.axis) +
         ", order: " + (symmetry.order == 0 ? "inf" : std::to_string(symmetry.order)) + "}";
}

/// What the BOP errors need to know of a model.
std::string modelText(const TrainingEntry& entry) {
  std::string text;
  if (entry.diameter) text += ", diameter: " + formatted("%.9g", *entry.diameter);
  if (!entry.symmetries) return text;
  std::string discrete, continuous;
  for (const Eigen::Isometry3d& motion : entry.symmetries->discrete) {
    const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> pose = motion.matrix();
    discrete += (discrete.empty() ? "" : ", ") +
                ("{pose: " + yamlList(std::vector<double>(pose.data(), pose.data() + 16)) + "}");
  }
  for (const ObjectSymmetries::Axis& axis : entry.symmetries->continuous) {
    continuous += (continuous.empty() ? "" : ", ") +
                  ("{axis: " + listText(axis.direction) + ", offset: " + listText(axis.position) + "}");
  }
  if (!discrete.empty()) text += ", symmetries_discrete: [" + discrete + "]";
  if (!continuous.empty()) text += ", symmetries_continuous: [" + continuous + "]";
  return text;
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
            ", kind: " + kind + (entry.symmetry ? symmetryText(*entry.symmetry) : "") + modelText(entry) + "}\n";
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
