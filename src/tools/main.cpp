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
#include "tools/progress_bar.hpp"

namespace {

int fail(const std::string& message, int status) {
  std::cerr << "sks: " << sks::shownMessage(message) << std::endl;
  return status;
}

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

}  // namespace

int main(int argc, char** argv) {
  using namespace sks;
  std::locale::global(std::locale::classic());  // files are the same everywhere, whatever a library has set
  const std::unique_ptr<CLI::App> app = tools::makeApplication();
  tools::cancelOnInterrupt();
  try {
    app->parse(argc, argv);
    return 0;
  } catch (const CLI::Success& help) {
    return app->exit(help);
  } catch (const CLI::ParseError& error) {
    return fail(usageMessage(*app, error, argc > 1 ? argv[1] : "") + "; see --help", 2);
  } catch (const Error& error) {
    return fail(error.what(), error.code() == ErrorCode::bad_usage ? 2 : 1);
  } catch (const std::bad_alloc&) {
    return fail("out of memory", 1);
  } catch (const std::exception& error) {
    return fail(error.what(), 1);
  }
}
