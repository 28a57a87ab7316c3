// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <optional>

#include <sks_detector/cloud_io.hpp>
#include <sks_detector/error.hpp>
#include <sks_detector/settings_file.hpp>
#include <sks_detector/thresholds.hpp>

#include "evaluation/evaluation.hpp"
#include "evaluation/registered_truth.hpp"
#include "evaluation/shared_scoring.hpp"
#include "io/crc32c.hpp"
#include "io/dataset.hpp"
#include "io/file.hpp"
#include "tools/bop_results.hpp"
#include "tools/cluster/cluster.hpp"
#include "tools/cluster/journal.hpp"
#include "tools/codebook_options.hpp"
#include "tools/codebook_summary.hpp"
#include "tools/command.hpp"
#include "tools/evaluation_json.hpp"
#include "tools/evaluation_plots.hpp"
#include "tools/evaluation_table.hpp"
#include "tools/method.hpp"
#include "tools/object_models.hpp"
#include "tools/progress_bar.hpp"

namespace sks::tools {
namespace {

struct EvaluateOptions {
  std::string dataset;
  MethodOption method;
  std::string plot;
  std::string bop_results;
  CodebookOptions codebook;
  SettingsOptions settings;
  JsonOption json;
  bool resume = false;
};

/// What the detections of a run depend on, in one line for its journal.
std::string workOf(const EvaluateOptions& options, const DataSet& data_set, const Codebook& codebook,
                   Settings settings) {
  settings.threads = Settings().threads;
  nlohmann::json own;
  options.method.addSettings(own);
  std::string all = settingsToYaml(settings) + own.dump() + std::to_string(data_set.scale);
  for (const Scene& scene : data_set.scenes) all += "\n" + scene.name + "\n" + scene.path;
  return std::string(SKS_VERSION) + " codebook " + checksumText(codebook) + " method " + options.method.name() +
         " settings and scenes " + std::to_string(crc32c(all.data(), all.size()));
}

void run(EvaluateOptions& options) {
  std::shared_ptr<const Codebook> codebook = options.codebook.read();
  Settings settings = codebook ? codebook->settings : Settings();
  options.method.applyForScenes(options.settings, settings);
  const DataSet data_set = loadDataSet(options.dataset);
  for (const std::string& warning : data_set.warnings) warn(warning);
  options.json.check();  // what cannot be written is found before the work is done
  if (options.resume && (options.json.path().empty() || options.json.onStdout())) {
    throw Error(ErrorCode::bad_usage, "--resume needs --json FILE: its journal is written beside that file");
  }
  options.codebook.check();
  if (!options.bop_results.empty()) {
    checkBopNames(data_set);
    if (leads()) checkWritable(options.bop_results);
  }
  if (!options.plot.empty() && leads()) preparePlots(options.plot);

  ProgressBar bar;
  if (!codebook) codebook = options.codebook.train(data_set, settings, bar.callback());
  bar.clear();
  if (settings.descriptor.type == DescriptorType::automatic) settings.descriptor.type = codebook->descriptor_type;
  for (const std::string& object : untrainedObjects(data_set, codebook->objects)) {
    warn("object '" + object + "' of the ground truth was never trained: it counts as missed");
  }
  for (const std::string& warning : thresholdWarnings(settings.detection, codebook->objects)) warn(warning);
  const DetectFunction detect = options.method.detectFunction(codebook, settings);
  std::optional<Journal> journal;
  if (options.resume && leads()) {
    journal.emplace(options.json.path() + ".journal", workOf(options, data_set, *codebook, settings));
  }
  JournaledShare journaled(workShare(), journal ? &*journal : nullptr);
  Evaluation evaluation = evaluate(registeredTruth(data_set, *codebook), detect, options.method.name(), settings,
                                   bar.callback(), options.resume ? &journaled : workShare());
  scoreAsBop(evaluation, data_set, objectModels(data_set), threadCount(settings), bar.callback(), workShare());
  if (!leads()) return;
  bar.clear();
  nlohmann::json json = evaluationJson(evaluation, codebook->objects);
  options.method.addSettings(json["settings"]);
  options.json.write(json);
  if (journal) journal->remove();
  if (!options.bop_results.empty()) writeFileAtomically(options.bop_results, bopResults(data_set, evaluation));
  if (!options.json.onStdout()) print(evaluationTable(evaluation));
  if (options.plot.empty()) return;
  const auto clouds = [&](std::size_t scene) { return readCloud(data_set.scenes[scene].path, data_set.scale); };
  writePlots(options.plot, clouds, evaluation, json, bar.callback());
}

}  // namespace

void addEvaluate(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "evaluate",
      "trains unless given a codebook, detects in every scene of a data set and scores what was found, also "
      "as the BOP challenge does where there are meshes");
  const auto options = std::make_shared<EvaluateOptions>();
  command->add_option("--dataset,-d", options->dataset, "data set file (YAML) with the ground truth")
      ->required()
      ->type_name("FILE");
  options->codebook.add(*command);
  options->method.add(*command, MethodTask::scenes);
  options->settings.add(*command);
  options->json.add(*command);
  command->add_flag("--resume", options->resume,
                    "keep a journal beside the file of --json (FILE.journal) until that is written, and go on where a "
                    "run that was ended has stopped");
  command->add_option("--plot", options->plot, "draw precision-recall curves, thresholds, times and each scene")
      ->type_name("DIR");
  command
      ->add_option("--bop-results", options->bop_results,
                   "write every detection in the result format of the BOP challenge (of a set of sks import bop)")
      ->type_name("FILE");
  command->callback([options] { run(*options); });
}

}  // namespace sks::tools
