// SPDX-License-Identifier: BSD-3-Clause
#include "tools/application.hpp"

#include "tools/bag.hpp"
#include "tools/command.hpp"

namespace sks::tools {

std::unique_ptr<CLI::App> makeApplication() {
  auto app = std::make_unique<CLI::App>("Finds known objects in cluttered RGB-D point clouds.", "sks");
  app->require_subcommand(1);
  app->set_version_flag("--version", std::string("sks ") + SKS_VERSION);
  addTrain(*app);
  addMerge(*app);
  addDetect(*app);
  addEvaluate(*app);
  addClassify(*app);
  addKeypoints(*app);
  addImport(*app);
  addSimulate(*app);
  addBag(*app);
  addInfo(*app);
  addVerify(*app);
  addSettings(*app);
  return app;
}

}  // namespace sks::tools
