// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include <sks_detector/codebook_file.hpp>
#include <sks_detector/detector.hpp>

#include "simulation/builtin_objects.hpp"
#include "tools/codebook_summary.hpp"
#include "tools/command.hpp"
#include "tools/mesh_options.hpp"
#include "tools/mesh_summary.hpp"

namespace sks::tools {
namespace {

struct InfoOptions {
  std::string codebook;  // or a mesh
  std::string scale;     // of a mesh
  JsonOption json;
};

void runMeshInfo(const InfoOptions& options) {
  const LoadedMesh loaded = findMesh(options.codebook, meshScale(options.scale));
  for (const std::string& warning : loaded.warnings) warn(warning);
  options.json.write(meshJson(options.codebook, loaded));
  if (!options.json.onStdout()) print(meshText(options.codebook, loaded));
}

void runInfo(const InfoOptions& options) {
  if (isMeshName(options.codebook) || options.codebook.rfind("builtin:", 0) == 0) {
    runMeshInfo(options);
    return;
  }
  const auto codebook = readCodebook(options.codebook);
  options.json.write(codebookJson(options.codebook, *codebook));
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
