// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run_program.hpp"

#include <cerrno>
#include <system_error>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <sks_detector/error.hpp>

namespace sks::tools {

int runProgram(const std::vector<std::string>& arguments) {
  const auto fail = [&](int reason) {
    throw Error(ErrorCode::bad_file,
                "cannot run '" + arguments.front() + "': " + std::generic_category().message(reason));
  };
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);  // stdout is for results
  pid_t child = 0;
  const int reason = posix_spawn(&child, argv.front(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (reason != 0) fail(reason);
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) fail(errno);
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace sks::tools
