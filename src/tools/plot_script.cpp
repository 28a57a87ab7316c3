// SPDX-License-Identifier: BSD-3-Clause
#include "tools/plot_script.hpp"

#include <sks_detector/error.hpp>

#include "tools/run_program.hpp"
#include "tools/share.hpp"

namespace sks::tools {

void runPlotScript(const std::string& script, const std::vector<std::string>& arguments) {
  std::vector<std::string> command{"/usr/bin/python3", sharePath(script)};
  command.insert(command.end(), arguments.begin(), arguments.end());
  const int status = runProgram(command);
  if (status == 0) return;
  throw Error(ErrorCode::bad_file, command[1] + " failed with exit status " + std::to_string(status) +
                                       "; see its message above, or leave out --plot");
}

}  // namespace sks::tools
