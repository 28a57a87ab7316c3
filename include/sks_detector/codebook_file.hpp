// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include <sks_detector/codebook.hpp>

namespace sks {

/// Version of the file format that this build writes; it reads this and all earlier ones.
constexpr std::uint32_t codebook_file_version = 1;

/// Writes a codebook whole or not at all (temporary name, sync, rename); see docs/codebook_file.md.
/// @return the checksum that was stored
/// @throws Error(bad_file) with the path and the system's reason
std::uint32_t writeCodebook(const std::string& path, const Codebook& codebook);

/// The checksum that writeCodebook() would store. @throws Error(bad_file) if the codebook cannot be stored
std::uint32_t codebookChecksum(const Codebook& codebook);

/// Reads a codebook file whole, so that whoever writes to it later changes nothing; descriptors stay where they were
/// read to, as long as the result lives. Checks magic, version, checksum, FlatBuffers verifier and every index and
/// length before anything is used.
/// @throws Error(bad_file) naming the path and what is wrong: missing, foreign, truncated, damaged, newer
std::shared_ptr<const Codebook> readCodebook(const std::string& path);

}  // namespace sks
