// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <sks_detector/error.hpp>
#include <sks_detector/settings.hpp>

namespace sks {

/// Most threads that threadCount() gives: the number of cores, or 16 if that is more. More make nothing faster and
/// change no result, but each takes memory.
int mostThreads();

/// What is to be said where `settings.threads` is more than that; else empty.
std::string tooManyThreads(const Settings& settings);

/// threadCount(), once the system has been seen to give the calling thread so many. OpenMP, which starts them for each
/// thread that calls it, would end the process where it gets fewer.
/// @throws Error(bad_usage) naming setting, reason and remedy where they cannot be started
int startableThreads(const Settings& settings);

/// The error for threads that cannot be started. @param what e.g. "4 threads" @param reason of the system
Error threadError(const std::string& what, const std::string& reason);

}  // namespace sks
