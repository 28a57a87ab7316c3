// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstring>
#include <memory>
#include <string>

#include <sks_detector/codebook_file.hpp>

#include "io/codebook_layout.hpp"
#include "io/crc32c.hpp"
#include "memory_file.hpp"
#include "refused.hpp"

namespace sks::fuzz {

/// Reads a codebook file, its checksums put right first: what lies behind them must withstand anything, too. Null if it
/// is refused.
inline std::shared_ptr<const Codebook> readCodebookFile(const std::uint8_t* data, std::size_t size) {
  std::string content(reinterpret_cast<const char*>(data), size);
  if (CodebookHeader header; size >= sizeof(header)) {
    std::memcpy(&header, content.data(), sizeof(header));
    header.payload_checksum = crc32c(content.data() + sizeof(header), size - sizeof(header));
    header.header_checksum = header.ownChecksum();
    std::memcpy(&content[0], &header, sizeof(header));
  }
  const MemoryFile file(content.data(), content.size());
  std::shared_ptr<const Codebook> codebook;
  refused([&] { codebook = readCodebook(file.path()); });
  return codebook;
}

}  // namespace sks::fuzz
