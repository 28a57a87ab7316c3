// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include <sks_detector/codebook_file.hpp>
#include <sks_detector/detector.hpp>

#include "tools/codebook_summary.hpp"
#include "tools/command.hpp"

namespace sks::tools {
namespace {

struct InfoOptions {
  std::string codebook;
  JsonOption json;
};

void addCodebook(CLI::App& command, InfoOptions& options) {
  command.add_option("codebook", options.codebook, "codebook file (*.sks)")->required()->type_name("FILE");
}

void runInfo(const InfoOptions& options) {
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
  CLI::App* command = app.add_subcommand("info", "shows what a codebook holds");
  const auto options = std::make_shared<InfoOptions>();
  addCodebook(*command, *options);
  options->json.add(*command);
  command->callback([options] { runInfo(*options); });
}

void addVerify(CLI::App& app) {
  CLI::App* command = app.add_subcommand("verify", "checks that a codebook is whole and can be used");
  const auto options = std::make_shared<InfoOptions>();
  addCodebook(*command, *options);
  command->callback([options] { runVerify(*options); });
}

}  // namespace sks::tools
