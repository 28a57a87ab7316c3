// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <string>
#include <vector>

#include <sks_detector/codebook_file.hpp>
#include <sks_detector/detector.hpp>
#include <sks_detector/error.hpp>

#include "simulation/builtin_objects.hpp"
#include "tools/codebook_summary.hpp"
#include "tools/command.hpp"
#include "tools/mesh_options.hpp"
#include "tools/mesh_summary.hpp"
#include "tools/model_export.hpp"

namespace sks::tools {
namespace {

struct InfoOptions {
  std::string codebook;  // or a mesh
  std::string scale;     // of a mesh
  std::string models;    // folder
  JsonOption json;
};

void runMeshInfo(const InfoOptions& options) {
  const LoadedMesh loaded = findMesh(options.codebook, meshScale(options.scale));
  for (const std::string& warning : loaded.warnings) warn(warning);
  options.json.write(meshJson(options.codebook, loaded));
  if (!options.json.onStdout()) print(meshText(options.codebook, loaded));
}

/// @return the files
std::vector<std::string> exportModels(const std::string& folder, const Codebook& codebook) {
  if (folder.empty()) return {};
  std::vector<std::string> files;
  std::vector<std::string> objects;
  for (const RegisteredModel& model : codebook.models) objects.push_back(codebook.objects[model.object]);
  prepareModelExport(folder, objects);
  for (const RegisteredModel& model : codebook.models) {
    const double spacing = codebook.settings.training.surface_resolution;
    for (const std::string& file : exportModel(folder, codebook.objects[model.object], model.surface, spacing)) {
      files.push_back(file);
    }
  }
  if (files.empty())
    warn("no model to export: the codebook holds none; registered views give one, see docs/training.md");
  return files;
}

void runInfo(const InfoOptions& options) {
  if (isMeshName(options.codebook) || options.codebook.rfind("builtin:", 0) == 0) {
    if (!options.models.empty()) throw Error(ErrorCode::bad_usage, "--export-models is for codebooks");
    runMeshInfo(options);
    return;
  }
  const auto codebook = readCodebook(options.codebook);
  nlohmann::json json = codebookJson(options.codebook, *codebook);
  json["models"] = exportModels(options.models, *codebook);
  options.json.write(json);
  if (options.json.onStdout()) return;
  print(codebookTable(options.codebook, *codebook));
}

/// Reading checks the file; making a detector checks the descriptors.
void runVerify(const InfoOptions& options) {
  const auto codebook = readCodebook(options.codebook);
  const Detector detector(codebook, codebook->settings);
  print(options.codebook + ": whole, " + std::to_string(codebook->objects.size()) + " objects, " +
        std::to_string(codebook->views.size()) + " training clouds, " + std::to_string(codebook->words.size()) +
        " codewords, checksum " + checksumText(*codebook) + "\n");
}

}  // namespace

void addInfo(CLI::App& app) {
  CLI::App* command = app.add_subcommand("info", "shows what a codebook or a mesh holds");
  const auto options = std::make_shared<InfoOptions>();
  command->add_option("file", options->codebook, "codebook (*.sks) or mesh (OBJ, PLY, STL, DAE, glTF, builtin:mug)")
      ->required()
      ->type_name("FILE");
  addMeshScale(*command, options->scale);
  command
      ->add_option("--export-models", options->models,
                   "write the models that the codebook holds as PLY clouds (NAME.ply) and meshes (NAME_mesh.ply)")
      ->type_name("DIR");
  options->json.add(*command);
  command->callback([options] { runInfo(*options); });
}

void addVerify(CLI::App& app) {
  CLI::App* command = app.add_subcommand("verify", "checks that a codebook is whole and can be used");
  const auto options = std::make_shared<InfoOptions>();
  command->add_option("codebook", options->codebook, "codebook file (*.sks)")->required()->type_name("FILE");
  command->callback([options] { runVerify(*options); });
}

}  // namespace sks::tools
