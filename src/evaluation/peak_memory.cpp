// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/peak_memory.hpp"

#include <fstream>
#include <string>

#include <sys/resource.h>

namespace sks {

double peakMemoryMb() {
  // getrusage() hands down the peak of the process that started this one, so the kernel's own mark comes first
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("VmHWM:", 0) == 0) return double(std::stoll(line.substr(6))) / 1024.0;
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) / 1024.0;
}

}  // namespace sks
