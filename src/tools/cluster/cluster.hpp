// SPDX-License-Identifier: BSD-3-Clause
// What the command line knows of the other processes of its run. Without a launcher there are none, and nothing is
// loaded or started for them.
#pragma once

#include <string>

#include "core/sharing/work_share.hpp"

namespace sks::tools {

/// Joins the processes of this run where mpirun or srun started several. @param command the subcommand that is asked
/// for
/// @throws Error(bad_usage) for a command that is not shared, or where the build has no MPI
void joinProcesses(const std::string& command);

/// To be passed on to what shares its work; null without other processes.
WorkShare* workShare();

/// Whether this process collects, writes and speaks: one of a run does.
bool leads();

/// The end of a run, good (status 0) or bad: says what went wrong, once, and ends the other processes.
/// @return the exit status
int endRun(int status, const std::string& message);

}  // namespace sks::tools
