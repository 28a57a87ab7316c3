// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulation.hpp"

#include <sks_detector/error.hpp>

namespace sks::tools {
namespace {

[[noreturn]] void refuse() {
  throw Error(ErrorCode::bad_usage,
              "this program was built without its virtual camera: install libassimp-dev, libembree-dev and "
              "libbullet-dev, and build it again");
}

}  // namespace

void addSimulate(CLI::App& app) {
  CLI::App* command = app.add_subcommand("simulate", "not in this build: needs libassimp, libembree and libbullet");
  command->allow_extras();
  command->callback([] { refuse(); });
}

MeshSampler meshSampler(int, double, bool) {
  return [](const TrainingEntry&, double) -> std::vector<TrainingSample> { refuse(); };
}

std::vector<std::string> builtinObjects() {
  refuse();
}

}  // namespace sks::tools
