// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace sks {

/// Writes `content` to `path` whole or not at all: to a temporary name in the same folder, synced, then renamed.
/// @throws Error(bad_file) naming the path and the system's reason; the old file is then untouched
void writeFileAtomically(const std::string& path, const std::string& content);

/// The same where there is no such file yet; one that is there stays, also if it came while this one was written.
/// @return whether it was written
bool writeNewFileAtomically(const std::string& path, const std::string& content);

/// Makes a folder and those above it, where they are not there. @throws Error(bad_file)
void makeFolder(const std::string& path);

/// Throws now what writing to `path` would throw later: no such folder, no permission. @throws Error(bad_file)
void checkWritable(const std::string& path);

/// Reads a whole file, regular ones only. @throws Error(bad_file) naming the path and the reason, also where it exceeds
/// `max_bytes`
std::string readTextFile(const std::string& path, std::size_t max_bytes = 64u << 20);

}  // namespace sks
