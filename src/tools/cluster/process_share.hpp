// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/sharing/work_share.hpp"

namespace sks::tools {

/// The processes that a launcher (mpirun, srun) started together.
class ProcessShare : public WorkShare {
public:
  /// How many of them run on this machine, this one included.
  virtual int processesHere() const = 0;

  /// Hands the leader a failure, by which it ends the run; to be called by others. Waits some seconds for that.
  virtual void hand(const std::string& message, int status) = 0;
  /// Ends all processes at once. The launcher then exits with the status.
  virtual void abort(int status) = 0;
  /// Ends the share after all processes have done their work. @throws Error where one of them failed after all
  virtual void finish() = 0;
};

/// What the library holds that does this by MPI; it is loaded only where a launcher has started several processes.
constexpr const char* share_library = "libsks_detector_mpi.so";
constexpr const char* share_function = "sksJoinProcesses";
/// @return never null; lives until the process ends
using JoinProcesses = ProcessShare* (*)();

}  // namespace sks::tools
