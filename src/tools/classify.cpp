// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <set>

#include <sks_detector/settings_file.hpp>

#include "evaluation/classification.hpp"
#include "io/dataset.hpp"
#include "tools/classification_report.hpp"
#include "tools/cluster/cluster.hpp"
#include "tools/codebook_options.hpp"
#include "tools/command.hpp"
#include "tools/method.hpp"
#include "tools/progress_bar.hpp"
#include "tools/share.hpp"

namespace sks::tools {
namespace {

struct ClassifyOptions {
  std::string dataset;
  MethodOption method;
  CodebookOptions codebook;
  SettingsOptions settings;
  JsonOption json;
};

/// What the settings start from: those of the codebook, else of the preset for shapes that stand alone.
Settings startingSettings(const Codebook* codebook) {
  if (codebook != nullptr) return codebook->settings;
  Settings settings;
  loadSettings(sharePath("config/classify.yaml"), settings);
  return settings;
}

void warnOfUntrained(const DataSet& data_set, const std::vector<std::string>& trained) {
  std::set<std::string> known(trained.begin(), trained.end());
  for (const TestEntry& test : data_set.tests) {
    if (!known.insert(test.object).second) continue;
    warn("object '" + test.object + "' of the tests was never trained: it counts as missed");
  }
}

void run(ClassifyOptions& options) {
  std::shared_ptr<const Codebook> codebook = options.codebook.read();
  Settings settings = startingSettings(codebook.get());
  options.method.applyForIsolatedObjects(options.settings, settings);
  const DataSet data_set = loadDataSet(options.dataset);
  for (const std::string& warning : data_set.warnings) warn(warning);
  options.json.check();
  options.codebook.check();

  ProgressBar bar;
  if (!codebook) codebook = options.codebook.train(data_set, settings, bar.callback());
  bar.clear();
  warnOfUntrained(data_set, codebook->objects);
  const ClassifyFunction classify = options.method.classifyFunction(codebook, settings);
  const ClassificationEvaluation evaluation =
      evaluateTests(data_set, classify, options.method.name(), settings, bar.callback(), workShare());
  if (!leads()) return;
  bar.clear();
  nlohmann::json json = classificationJson(evaluation);
  options.method.addSettings(json["settings"]);
  options.json.write(json);
  if (!options.json.onStdout()) print(classificationTable(evaluation));
}

}  // namespace

void addClassify(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "classify", "trains unless given a codebook, and says which object each isolated cloud under 'tests' is");
  const auto options = std::make_shared<ClassifyOptions>();
  command->add_option("--dataset,-d", options->dataset, "data set file (YAML) with tests")
      ->required()
      ->type_name("FILE");
  options->method.add(*command, MethodTask::isolated_objects);
  options->codebook.add(*command);
  options->settings.add(*command);
  options->json.add(*command);
  command->footer(
      "Without --codebook, settings start from config/classify.yaml;\nsks-paper then compares densities as published, "
      "lets only the nearest codeword vote and drops half of the keypoints.");
  command->callback([options] { run(*options); });
}

}  // namespace sks::tools
