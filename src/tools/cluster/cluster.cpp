// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cluster/cluster.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <thread>

#include <dlfcn.h>

#include <sks_detector/error.hpp>

#include "core/settings/core_share.hpp"
#include "core/settings/shown_text.hpp"
#include "tools/cluster/process_share.hpp"

namespace sks::tools {
namespace {

constexpr std::array<const char*, 5> shared_commands{"train", "evaluate", "classify", "keypoints", "simulate"};
constexpr std::chrono::seconds for_the_first{1};  // to say what is wrong, before the launcher ends it

ProcessShare* process_share = nullptr;

int numberIn(const char* variable, int otherwise) {
  const char* text = std::getenv(variable);
  return text != nullptr && *text != '\0' ? std::atoi(text) : otherwise;
}

/// As the launchers tell it: Open MPI's; those that speak PMI; Slurm's, which speaks PMIx.
int launchedProcesses() {
  const int tasks = std::getenv("PMIX_RANK") != nullptr ? numberIn("SLURM_STEP_NUM_TASKS", 1) : 1;
  return numberIn("OMPI_COMM_WORLD_SIZE", numberIn("PMI_SIZE", tasks));
}

int launchedRank() {
  return numberIn("OMPI_COMM_WORLD_RANK", numberIn("PMI_RANK", numberIn("PMIX_RANK", 0)));
}

void say(const std::string& message) {
  std::cerr << "sks: " + shownMessage(message) + "\n";  // at once: mpirun and other processes write there too
}

}  // namespace

void joinProcesses(const std::string& command) {
  const int processes = launchedProcesses();
  if (processes <= 1) return;
  const auto shared = [&](const char* name) { return command == name; };
  if (command.empty() || command[0] == '-') return;  // help
  if (std::none_of(shared_commands.begin(), shared_commands.end(), shared)) {
    throw Error(ErrorCode::bad_usage, "'sks " + command + "' does not share its work: start it without mpirun or srun");
  }
  void* const library = ::dlopen(share_library, RTLD_NOW | RTLD_GLOBAL);
  void* const function = library != nullptr ? ::dlsym(library, share_function) : nullptr;
  if (function == nullptr) {
    const char* reason = ::dlerror();
    throw Error(ErrorCode::bad_usage, std::to_string(processes) +
                                          " processes were started, but this sks cannot share work between them: "
                                          "install libopenmpi-dev and build it again, or start one process (" +
                                          (reason != nullptr ? reason : "no reason given") + ")");
  }
  process_share = reinterpret_cast<JoinProcesses>(function)();
  shareCores(process_share->processesHere());
}

WorkShare* workShare() {
  return process_share;
}

bool leads() {
  return process_share != nullptr ? process_share->leads() : launchedProcesses() <= 1 || launchedRank() == 0;
}

int endRun(int status, const std::string& message) {
  if (process_share == nullptr) {
    if (leads() && !message.empty()) say(message);
    if (!leads()) std::this_thread::sleep_for(for_the_first);
    return status;
  }
  if (status == 0) {
    try {
      process_share->finish();
      return 0;
    } catch (const Error& error) {
      say(error.what());
      process_share->abort(1);
      return 1;
    }
  }
  if (!leads()) process_share->hand(message, status);
  say(message);  // the leader; or another one, where it does not come to that
  process_share->abort(status);
  return status;
}

}  // namespace sks::tools
