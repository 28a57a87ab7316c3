// SPDX-License-Identifier: BSD-3-Clause
#include <exception>
#include <iostream>

#include <sks_detector/error.hpp>

#include "core/settings/nearest_name.hpp"
#include "tools/bag.hpp"
#include "tools/command.hpp"
#include "tools/progress_bar.hpp"

namespace {

int fail(const std::string& message, int status) {
  std::cerr << "sks: " << message << std::endl;
  return status;
}

/// What is wrong with the arguments; CLI11 would not name a misspelt subcommand.
std::string usageMessage(const CLI::App& app, const CLI::ParseError& error, const std::string& first_argument) {
  if (!app.get_subcommands().empty() || first_argument.empty() || first_argument[0] == '-') return error.what();
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return "unknown subcommand '" + first_argument + "': did you mean '" + sks::nearestName(first_argument, names) + "'?";
}

}  // namespace

int main(int argc, char** argv) {
  using namespace sks;
  CLI::App app("Finds known objects in cluttered RGB-D point clouds.", "sks");
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string("sks ") + SKS_VERSION);
  tools::addTrain(app);
  tools::addDetect(app);
  tools::addEvaluate(app);
  tools::addClassify(app);
  tools::addKeypoints(app);
  tools::addImport(app);
  tools::addSimulate(app);
  tools::addBag(app);
  tools::addInfo(app);
  tools::addVerify(app);
  tools::addSettings(app);
  tools::cancelOnInterrupt();
  try {
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    return fail(usageMessage(app, error, argc > 1 ? argv[1] : "") + "; see --help", 2);
  } catch (const Error& error) {
    return fail(error.what(), error.code() == ErrorCode::bad_usage ? 2 : 1);
  } catch (const std::bad_alloc&) {
    return fail("out of memory", 1);
  } catch (const std::exception& error) {
    return fail(error.what(), 1);
  }
}
