// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include <sks_detector/codebook_file.hpp>
#include <sks_detector/error.hpp>
#include <sks_detector/registration.hpp>
#include <sks_detector/trainer.hpp>

#include "core/pipeline/shared_training.hpp"
#include "core/pipeline/stopwatch.hpp"
#include "core/settings/name_text.hpp"
#include "io/codebook_layout.hpp"
#include "io/dataset.hpp"
#include "io/file.hpp"
#include "io/freed_memory.hpp"
#include "tools/cluster/cluster.hpp"
#include "tools/codebook_summary.hpp"
#include "tools/command.hpp"
#include "tools/mesh_options.hpp"
#include "tools/model_export.hpp"
#include "tools/progress_bar.hpp"
#include "tools/registration_report.hpp"
#include "tools/table.hpp"

namespace sks::tools {
namespace {

struct TrainOptions {
  std::string dataset;
  std::string output;
  std::string name;
  std::string models;  // folder
  MeshOptions meshes;
  MeshViewOptions mesh_views;
  SettingsOptions settings;
  JsonOption json;
};

/// What the data set file lists, then the meshes of the command line.
DataSet trainingSet(const TrainOptions& options) {
  DataSet data_set;
  data_set.name = "meshes";
  if (!options.dataset.empty()) {
    data_set = loadDataSet(options.dataset);
    for (const std::string& warning : data_set.warnings) warn(warning);
  } else if (!options.meshes.any()) {
    throw Error(ErrorCode::bad_usage, "there is nothing to train: give --dataset FILE, --mesh NAME=FILE or --builtin");
  }
  for (const TrainingEntry& entry : options.meshes.entries()) data_set.training.push_back(entry);
  if (data_set.training.empty()) {
    throw Error(ErrorCode::bad_data, "'" + options.dataset + "' has no training clouds; list them under 'training'");
  }
  return data_set;
}

void run(const TrainOptions& options) {
  checkCodebookName(options.output);
  if (!options.name.empty()) checkName(options.name, "--name");
  Settings settings;
  options.settings.apply(settings);
  const DataSet data_set = trainingSet(options);
  if (leads()) checkWritable(options.output);  // before training takes its time
  options.json.check();
  if (!options.models.empty() && leads()) {
    std::vector<std::string> objects;
    for (const TrainingEntry& entry : data_set.training) objects.push_back(entry.object);
    prepareModelExport(options.models, objects);
  }

  Stopwatch stopwatch;
  ProgressBar bar;
  RegisteredTraining trained =
      trainRegistered(trainingSamples(data_set, options.mesh_views.sampler()), settings,
                      options.name.empty() ? data_set.name : options.name, bar.callback(), {}, workShare());
  if (!leads()) return;
  Codebook& codebook = trained.codebook;
  bar.clear();
  for (const std::string& warning : registrationWarnings(trained.objects)) warn(warning);
  for (const std::string& warning : trainingWarnings(codebook)) warn(warning);
  returnFreedMemory();  // of meshes and clouds: writing takes memory in its place, not beside it
  writeAndRelease(options.output, codebook);
  std::vector<std::string> models;
  for (const RegisteredObject& object : trained.objects) {
    if (options.models.empty()) break;
    for (const std::string& file :
         exportModel(options.models, object.object, object.model, settings.training.surface_resolution)) {
      models.push_back(file);
    }
  }
  if (!options.models.empty() && models.empty()) {
    warn("no model to export: no views were registered to each other, see training.register_views");
  }
  const double seconds = stopwatch.lap();

  nlohmann::json json = codebookJson(options.output, codebook);
  json["seconds"] = seconds;
  json["models"] = models;
  json["registration"] = registrationJson(trained.objects);
  options.json.write(json);
  if (options.json.onStdout()) return;
  print(codebookTable(options.output, codebook) + registrationText(trained.objects) + "trained in " +
        fixed(seconds, 1) + " s\n");
}

}  // namespace

void addTrain(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("train", "trains a codebook from the training clouds of a data set and from meshes");
  const auto options = std::make_shared<TrainOptions>();
  command->add_option("--dataset,-d", options->dataset, "data set file (YAML) that lists the training clouds")
      ->type_name("FILE");
  command->add_option("--output,-o", options->output, "codebook file to write (*.sks)")->required()->type_name("FILE");
  command->add_option("--name", options->name, "name of the codebook (default: that of the data set)");
  command
      ->add_option("--export-models", options->models,
                   "write the models of objects whose views were registered as PLY clouds (NAME.ply) and meshes "
                   "(NAME_mesh.ply)")
      ->type_name("DIR");
  options->meshes.add(*command);
  options->mesh_views.add(*command);
  options->settings.add(*command);
  options->json.add(*command);
  command->callback([options] { run(*options); });
}

}  // namespace sks::tools
