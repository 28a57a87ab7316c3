// SPDX-License-Identifier: BSD-3-Clause
// The header of a codebook file and where its sections lie; see docs/codebook_file.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include <sks_detector/codebook.hpp>

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "codebook files are used as they lie in memory");

namespace sks {

/// Start of every section, and size of the header.
constexpr std::uint64_t codebook_alignment = 64;

/// The first version whose descriptors are levels and scales, as in QuantizedDescriptors; they were floats before.
constexpr std::uint32_t first_quantized_version = 2;

/// The start of a section behind what ends at an offset.
constexpr std::uint64_t alignedOffset(std::uint64_t end) {
  return (end + codebook_alignment - 1) / codebook_alignment * codebook_alignment;
}

/// Where the levels of descriptors begin in their section, behind the scales of the rows [bytes].
constexpr std::uint64_t levelsOffset(std::uint64_t rows) {
  return alignedOffset(rows * sizeof(float));
}

/// FlatBuffers' own limit, 2 GiB less one byte.
constexpr std::uint64_t largest_metadata = 2147483646;

/// Bytes of the name of a model frame at most: views share it in the file, but not in memory.
constexpr std::size_t longest_frame = 4096;

/// Marks the names of descriptors of a user's own.
constexpr const char* own_prefix = "own:";

/// The first 64 bytes as they lie in the file. All versions of the format share them.
struct CodebookHeader {
  char magic[8] = {'S', 'K', 'S', 'C', 'O', 'D', 'E', 'B'};
  std::uint32_t version = 0;
  std::uint32_t header_size = 64;
  std::uint64_t file_size = 0;
  std::uint64_t metadata_offset = 0;
  std::uint64_t metadata_size = 0;
  std::uint64_t descriptors_offset = 0;
  std::uint64_t descriptors_size = 0;  ///< bytes
  std::uint32_t payload_checksum = 0;  ///< CRC-32C of all bytes after the header
  std::uint32_t header_checksum = 0;   ///< CRC-32C of the 60 bytes before it

  std::uint32_t ownChecksum() const;
};
static_assert(sizeof(CodebookHeader) == 64, "the header must have no padding");

/// Checks magic, checksums, version and the offsets of the sections, in the order that gives the best message.
/// @throws Error(bad_file) saying what is wrong and what helps, without the file's name
CodebookHeader checkCodebookHeader(const std::uint8_t* file, std::size_t size);

/// Refuses a file to be written that is not called like a codebook, *.sks, unless it is a pipe or a device.
/// @throws Error(bad_usage)
void checkCodebookName(const std::string& path);

/// What the file says of the descriptors: shot, cshot, or own:NAME.
std::string descriptorText(const Codebook& codebook);

/// Takes it over from a file. @return false if it is none of these
bool readDescriptorText(const std::string& text, Codebook& codebook);

/// Why the parts of a codebook do not fit together (an index or count out of range, a number that is not finite);
/// empty if they do.
std::string codebookFault(const Codebook& codebook);

}  // namespace sks
