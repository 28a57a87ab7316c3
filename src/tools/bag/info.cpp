// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include <sks_detector/error.hpp>

#include "tools/bag/bag_info_text.hpp"
#include "tools/bag/commands.hpp"
#include "tools/command.hpp"
#include "tools/progress_bar.hpp"

namespace sks::tools {
namespace {

struct BagInfoOptions {
  std::string bag;
  JsonOption json;
};

void run(const BagInfoOptions& options) {
  options.json.check();
  const BagFile bag(options.bag);
  ProgressBar bar;
  const BagReport report = inspectBag(bag, bar.callback());
  bar.clear();
  options.json.write(bagInfoJson(bag, report));
  if (!options.json.onStdout()) print(bagInfoText(bag, report));
  if (report.usableTopics().empty()) {
    throw Error(ErrorCode::bad_data, "'" + options.bag + "' has no cloud that the node could use; see the remarks");
  }
}

}  // namespace

void addBagInfo(CLI::App& bag) {
  CLI::App* command =
      bag.add_subcommand("info", "checks clouds, stamps, transforms and camera: what the node would complain about");
  const auto options = std::make_shared<BagInfoOptions>();
  command->add_option("bag", options->bag, "bag file")->required()->type_name("FILE");
  options->json.add(*command);
  command->callback([options] { run(*options); });
}

}  // namespace sks::tools
