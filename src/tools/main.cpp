// SPDX-License-Identifier: BSD-3-Clause
#include <exception>
#include <iostream>

#include <sks_detector/error.hpp>

#include "tools/command.hpp"
#include "tools/progress_bar.hpp"

namespace {

int fail(const std::string& message, int status) {
  std::cerr << "sks: " << message << std::endl;
  return status;
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
    return fail(std::string(error.what()) + "; see --help", 2);
  } catch (const Error& error) {
    return fail(error.what(), error.code() == ErrorCode::bad_usage ? 2 : 1);
  } catch (const std::bad_alloc&) {
    return fail("out of memory", 1);
  } catch (const std::exception& error) {
    return fail(error.what(), 1);
  }
}
