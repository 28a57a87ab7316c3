// SPDX-License-Identifier: BSD-3-Clause
// PLY files, as readCloud() takes them.
#include "cloud_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  sks::fuzz::readCloudFile(data, size);
  return 0;
}
