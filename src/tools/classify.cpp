// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <set>

#include <sks_detector/classification.hpp>
#include <sks_detector/dataset.hpp>
#include <sks_detector/settings_file.hpp>

#include "tools/classification_report.hpp"
#include "tools/codebook_options.hpp"
#include "tools/command.hpp"
#include "tools/method.hpp"
#include "tools/progress_bar.hpp"
#include "tools/share.hpp"

namespace sks::tools {
namespace {

struct Options {
  std::string dataset;
  std::string method = "sks";
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

void run(const Options& options) {
  std::shared_ptr<const Codebook> codebook = options.codebook.read();
  Settings settings = startingSettings(codebook.get());
  applyClassificationMethod(options.method, options.settings, settings);
  const DataSet data_set = loadDataSet(options.dataset);
  for (const std::string& warning : data_set.warnings) warn(warning);
  options.json.check();
  options.codebook.check();

  ProgressBar bar;
  if (!codebook) codebook = options.codebook.train(data_set, settings, bar.callback());
  bar.clear();
  warnOfUntrained(data_set, codebook->objects);
  const bool published = options.method == "sks-paper";
  const Classifier classifier(codebook, settings, published ? ClassBalance::none : ClassBalance::codewords);
  const ViewKind kind = testKind(*codebook);
  const auto classify = [&](const Cloud& cloud) { return classifier.classify(cloud, kind); };
  const ClassificationEvaluation evaluation =
      evaluateTests(data_set, classify, options.method, settings, bar.callback());
  bar.clear();
  options.json.write(classificationJson(evaluation));
  if (!options.json.onStdout()) print(classificationTable(evaluation));
}

}  // namespace

void addClassify(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "classify", "trains unless given a codebook, and says which object each isolated cloud under 'tests' is");
  const auto options = std::make_shared<Options>();
  command->add_option("--dataset,-d", options->dataset, "data set file (YAML) with tests")
      ->required()
      ->type_name("FILE");
  command->add_option("--method,-m", options->method, methodHelp())
      ->type_name("NAME")
      ->check(CLI::IsMember(methodNames()));
  options->codebook.add(*command);
  options->settings.add(*command);
  options->json.add(*command);
  command->footer(
      "Without --codebook, settings start from config/classify.yaml;\nsks-paper then compares densities as published "
      "and drops half of the keypoints.");
  command->callback([options] { run(*options); });
}

}  // namespace sks::tools
