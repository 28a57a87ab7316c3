// SPDX-License-Identifier: BSD-3-Clause
#include <exception>
#include <iostream>
#include <locale>
#include <memory>
#include <string>
#include <vector>

#include <sks_detector/error.hpp>

#include "core/settings/nearest_name.hpp"
#include "core/settings/shown_text.hpp"
#include "tools/application.hpp"
#include "tools/cluster/cluster.hpp"
#include "tools/progress_bar.hpp"

namespace {

/// How a run ended; without a message nothing went wrong.
struct Ending {
  int status = 0;
  std::string message;
};

/// What is wrong with the arguments; CLI11 would not name a misspelt subcommand.
std::string usageMessage(const CLI::App& app, const CLI::ParseError& error, const std::string& first_argument) {
  if (!app.get_subcommands().empty() || first_argument.empty() || first_argument[0] == '-') return error.what();
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  const std::string nearest = sks::nearestName(first_argument, names);
  return "unknown subcommand '" + sks::shown(first_argument) + "'" +
         (nearest.empty() ? "" : ": did you mean '" + nearest + "'?");
}

Ending run(int argc, char** argv) {
  using namespace sks;
  const std::unique_ptr<CLI::App> app = tools::makeApplication();
  const std::string first_argument = argc > 1 ? argv[1] : "";
  try {
    tools::joinProcesses(first_argument);
    app->parse(argc, argv);
    return {};
  } catch (const CLI::Success& help) {
    return {tools::leads() ? app->exit(help) : 0, ""};
  } catch (const CLI::ParseError& error) {
    return {2, usageMessage(*app, error, first_argument) + "; see --help"};
  } catch (const Error& error) {
    return {error.code() == ErrorCode::bad_usage ? 2 : 1, error.what()};
  } catch (const std::bad_alloc&) {
    return {1, "out of memory"};
  } catch (const std::exception& error) {
    return {1, error.what()};
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::locale::global(std::locale::classic());  // files are the same everywhere, whatever a library has set
  sks::tools::cancelOnInterrupt();
  const Ending ending = run(argc, argv);
  return sks::tools::endRun(ending.status, ending.message);
}
