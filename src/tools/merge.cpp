// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <string>
#include <vector>

#include <sks_detector/codebook_file.hpp>
#include <sks_detector/error.hpp>

#include "core/pipeline/codebook_merge.hpp"
#include "core/settings/name_text.hpp"
#include "io/codebook_layout.hpp"
#include "io/file.hpp"
#include "tools/codebook_summary.hpp"
#include "tools/command.hpp"
#include "tools/force_option.hpp"

namespace sks::tools {
namespace {

struct MergeOptions {
  std::vector<std::string> codebooks;
  std::string output;
  std::string name;
  ForceOption force;
  JsonOption json;
};

void runMerge(const MergeOptions& options) {
  if (options.codebooks.size() < 2) {
    throw Error(ErrorCode::bad_usage, "there is nothing to merge: give at least two codebooks");
  }
  checkCodebookName(options.output);
  if (!options.name.empty()) checkName(options.name, "--name");
  options.force.checkFile(options.output);
  checkWritable(options.output);
  options.json.check();
  std::vector<CodebookPart> parts;
  for (const std::string& file : options.codebooks) parts.push_back({file, readCodebook(file)});
  const Codebook codebook = mergedCodebook(parts, options.name.empty() ? parts.front().codebook->name : options.name);
  parts.clear();  // writing takes memory in their place
  options.force.write(options.output, codebook);
  options.json.write(codebookJson(options.output, codebook));
  if (!options.json.onStdout()) print(codebookTable(options.output, codebook));
}

}  // namespace

void addMerge(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "merge",
      "joins codebooks that were trained apart, with the same settings, to the one that training all at once gives");
  const auto options = std::make_shared<MergeOptions>();
  command->add_option("codebooks", options->codebooks, "codebook files (*.sks), in the order of their objects")
      ->required()
      ->type_name("FILE");
  command->add_option("--output,-o", options->output, "codebook file to write (*.sks)")->required()->type_name("FILE");
  command->add_option("--name", options->name, "name of the codebook (default: that of the first one)");
  options->force.addForCodebook(*command);
  options->json.add(*command);
  command->callback([options] { runMerge(*options); });
}

}  // namespace sks::tools
