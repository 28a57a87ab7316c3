// SPDX-License-Identifier: BSD-3-Clause
#include "tools/bag/remarks.hpp"

namespace sks::tools {

std::string severityName(Severity severity) {
  return severity == Severity::error ? "error" : (severity == Severity::warning ? "warning" : "note");
}

std::string shareText(std::size_t part, std::size_t all, const std::string& things) {
  return std::to_string(part) + " of " + std::to_string(all) + " " + things;
}

}  // namespace sks::tools
