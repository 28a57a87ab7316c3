// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <memory>

#include "evaluation/keypoint_study.hpp"
#include "io/dataset.hpp"
#include "io/file.hpp"
#include "tools/cluster/cluster.hpp"
#include "tools/command.hpp"
#include "tools/keypoint_report.hpp"
#include "tools/plot_script.hpp"
#include "tools/progress_bar.hpp"

namespace sks::tools {
namespace {

constexpr const char* script = "scripts/plot_keypoints.py";

struct KeypointsOptions {
  std::string dataset;
  std::string plot;
  SettingsOptions settings;
  JsonOption json;
};

std::string csvFile(const KeypointsOptions& options) {
  return (std::filesystem::path(options.plot) / "keypoints.csv").string();
}

void run(const KeypointsOptions& options) {
  Settings settings;
  options.settings.apply(settings);
  const DataSet data_set = loadDataSet(options.dataset);
  for (const std::string& warning : data_set.warnings) warn(warning);
  options.json.check();  // what cannot be written is found before the work is done
  if (!options.plot.empty() && leads()) {
    makeFolder(options.plot);
    checkWritable(csvFile(options));
    runPlotScript(script, {"--check"});
  }
  ProgressBar bar;
  const KeypointStudy study = studyKeypoints(data_set, settings, bar.callback(), workShare());
  if (!leads()) return;
  bar.clear();
  if (study.skipped > 0) {
    warn(std::to_string(study.skipped) + " objects of the ground truth have no pose of a training cloud: left out");
  }
  options.json.write(keypointJson(study));
  if (!options.json.onStdout()) print(keypointTable(study));
  if (options.plot.empty()) return;
  writeFileAtomically(csvFile(options), keypointCsv(study));
  runPlotScript(script, {csvFile(options), options.plot});
}

}  // namespace

void addKeypoints(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "keypoints", "how well grid, SKS and ISS keypoints of each object are found again in each scene");
  const auto options = std::make_shared<KeypointsOptions>();
  command->add_option("--dataset,-d", options->dataset, "data set file (YAML) with poses in its ground truth")
      ->required()
      ->type_name("FILE");
  options->settings.add(*command);
  options->json.add(*command);
  command->add_option("--plot", options->plot, "write the ranked curves of C_rk and T_diff as CSV and picture")
      ->type_name("DIR");
  command->callback([options] { run(*options); });
}

}  // namespace sks::tools
