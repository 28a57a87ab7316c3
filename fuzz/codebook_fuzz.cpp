// SPDX-License-Identifier: BSD-3-Clause
// Codebook files: what is accepted is sound, and can be edited and stored.
#include "core/pipeline/codebook_edit.hpp"

#include "codebook_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto codebook = sks::fuzz::readCodebookFile(data, size);
  if (!codebook) return 0;
  sks::fuzz::require(sks::codebookFault(*codebook).empty(), "what is read is sound");
  sks::fuzz::refused([&] { sks::codebookChecksum(*codebook); });
  for (std::size_t i = 0; i < codebook->objects.size() && i < 4; ++i) {
    sks::fuzz::refused([&] { sks::withoutObject(*codebook, codebook->objects[i]); });
  }
  return 0;
}
