// SPDX-License-Identifier: BSD-3-Clause
#include "tools/bag.hpp"

#include "tools/bag/commands.hpp"

namespace sks::tools {

void addBag(CLI::App& app) {
  CLI::App* command = app.add_subcommand("bag", "checks a bag, cuts clouds out of it, scores recorded detections");
  command->require_subcommand(1);
  addBagInfo(*command);
  addBagExtract(*command);
  addBagEvaluate(*command);
}

}  // namespace sks::tools
