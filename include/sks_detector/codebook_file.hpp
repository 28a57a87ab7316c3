// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <sks_detector/codebook.hpp>

namespace sks {

/// Version of the file format that this build writes; it reads this and all earlier ones.
constexpr std::uint32_t codebook_file_version = 3;

/// Writes a codebook whole or not at all (temporary name, sync, rename); see docs/codebook_file.md.
/// @return codebookChecksum()
/// @throws Error(bad_file) with the path and the system's reason
std::uint32_t writeCodebook(const std::string& path, const Codebook& codebook);

/// The same, letting go of the surfaces of its views as they are written: a program that needs the codebook no more
/// takes less memory at most. All else of the codebook stays. If writing fails, some or all of them are gone.
std::uint32_t writeAndRelease(const std::string& path, Codebook& codebook);

/// As writeCodebook() where there is no such file yet; one that is there stays as it is, also if another thread or
/// process wrote it at the same time: of several one alone writes.
/// @return whether it was written
bool writeNewCodebook(const std::string& path, const Codebook& codebook);

/// By which a codebook is known: the CRC-32C of the payload of its file, whether it has been written or not. Computed
/// once for each codebook and then remembered, so do not change a codebook afterwards. May be called by several
/// threads.
/// @throws Error(bad_file) if the codebook cannot be stored
std::uint32_t codebookChecksum(const Codebook& codebook);

/// Reads a codebook file whole, so that whoever writes to it later changes nothing; descriptors stay where they were
/// read to, as long as the result lives (those of version 1, which were floats, are rounded). Checks magic, version,
/// checksum, FlatBuffers verifier and every index and length before anything is used.
/// @return not null; what Detector takes
/// @throws Error(bad_file) naming the path and what is wrong: missing, foreign, truncated, damaged, newer
std::shared_ptr<const Codebook> readCodebook(const std::string& path);

}  // namespace sks
