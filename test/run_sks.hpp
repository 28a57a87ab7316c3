// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "io/file.hpp"
#include "temporary_folder.hpp"

namespace sks::test {

/// What a run of the command line left behind.
struct CommandRun {
  int status = 0;      ///< exit status; -1 where a signal ended it
  std::string output;  ///< what was on stdout
  std::string errors;  ///< what was on stderr
};

/// Runs the command line `sks` without a shell; its stdout may be a device, from which nothing is read.
inline CommandRun runSks(const std::vector<std::string>& arguments, const std::string& device = "") {
  const TemporaryFolder folder;
  const std::string output = device.empty() ? folder.path("stdout") : device, errors = folder.path("stderr");
  std::string executable = SKS_EXECUTABLE;
  std::vector<char*> argv{executable.data()};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, errors.c_str(), O_WRONLY | O_CREAT, 0600);
  pid_t child = 0;
  const int reason = posix_spawn(&child, executable.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  if (reason != 0 || waitpid(child, &status, 0) != child) throw std::runtime_error("cannot run " + executable);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, device.empty() ? readTextFile(output) : "",
          readTextFile(errors)};
}

}  // namespace sks::test
