// SPDX-License-Identifier: BSD-3-Clause
#include <functional>
#include <map>
#include <memory>

#include <sks_detector/error.hpp>

#include "io/file.hpp"
#include "tools/command.hpp"
#include "tools/force_option.hpp"
#include "tools/import/importer.hpp"
#include "tools/progress_bar.hpp"

namespace sks::tools {
namespace {

using Importer = std::function<ImportedSet(const ImportContext&)>;

const std::map<std::string, Importer>& importers() {
  static const std::map<std::string, Importer> importers{{"unibo", importUnibo},       {"psb", importPrinceton},
                                                         {"modelnet", importModelNet}, {"washington", importWashington},
                                                         {"bigbird", importBigBird},   {"bop", importBop}};
  return importers;
}

std::vector<std::string> formatNames() {
  std::vector<std::string> names;
  for (const auto& importer : importers()) names.push_back(importer.first);
  return names;
}

void run(const std::string& format, ImportOptions options, const ForceOption& force) {
  if (!std::filesystem::is_directory(options.folder)) {
    throw Error(ErrorCode::bad_file, "'" + options.folder + "' is no folder; give the one that the data set lies in");
  }
  force.checkFile(options.output);
  checkWritable(options.output);
  if (options.name.empty()) {
    options.name = std::filesystem::canonical(options.folder).filename().string();
  }
  ProgressBar bar;
  ImportedSet set = importers().at(format)(ImportContext(options, bar.callback()));
  bar.clear();
  set.data_set.name = options.name;
  if (!options.units.empty()) set.units = options.units;
  const std::string yaml = dataSetYaml(set, options.output);
  const DataSet written = parseDataSet(yaml, options.output);  // what would be refused later is not left behind
  force.write(options.output, yaml);
  for (const std::string& warning : set.warnings) warn(warning);
  for (const std::string& warning : written.warnings) warn(warning);
  std::size_t instances = 0;
  for (const Scene& scene : written.scenes) instances += scene.objects.size();
  print(options.output + ": " + std::to_string(written.training.size()) + " training clouds, " +
        std::to_string(written.scenes.size()) + " scenes with " + std::to_string(instances) + " instances, " +
        std::to_string(written.tests.size()) + " tests, lengths in " + set.units + "\n");
}

}  // namespace

void addImport(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "import", "lists a public data set, as it is downloaded, in a data set file, and converts what has to be");
  const auto format = std::make_shared<std::string>();
  const auto options = std::make_shared<ImportOptions>();
  command
      ->add_option("format", *format,
                   "unibo, psb (Princeton Shape Benchmark), modelnet, washington (RGB-D Object Dataset), bigbird, bop")
      ->required()
      ->check(CLI::IsMember(formatNames()));
  command->add_option("folder", options->folder, "where it was unpacked")->required()->type_name("DIR");
  command->add_option("--output,-o", options->output, "data set file to write; converted clouds go beside it")
      ->required()
      ->type_name("FILE");
  command->add_option("--name", options->name, "of the data set (default: that of the folder)");
  command->add_option("--units", options->units, "of the clouds, where the format's own are wrong")
      ->check(CLI::IsMember({"m", "mm"}));
  command->add_option("--every", options->every, "take every n-th frame, image or turn (default: washington 5, else 1)")
      ->check(CLI::Range(1, 1000000));
  command->add_option("--split", options->split, "bop: folder of scenes (default: the first of test*, val*, train*)");
  command->add_option("--classification", options->classification, "psb: base (default), coarse1, coarse2, coarse3");
  command->add_option("--points", options->points, "psb, modelnet: points sampled from each mesh (default: 6000)")
      ->check(CLI::Range(100, 10000000));
  command
      ->add_option("--diagonal", options->diagonal,
                   "psb, modelnet: size to which each mesh is scaled [m] (default: 0.5)")
      ->check(CLI::Range(0.01, 100.0));
  command
      ->add_option("--models", options->models,
                   "bop: folder of meshes (default: models); T-LESS has models_cad, without colour, and models_reconst")
      ->type_name("NAME");
  const auto force = std::make_shared<ForceOption>();
  force->add(*command);
  command->callback([format, options, force] { run(*format, *options, *force); });
}

}  // namespace sks::tools
