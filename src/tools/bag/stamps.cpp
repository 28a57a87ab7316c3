// SPDX-License-Identifier: BSD-3-Clause
#include "tools/bag/stamps.hpp"

#include <cstdio>
#include <limits>
#include <regex>

namespace sks::tools {

std::string stampText(const ros::Time& stamp) {
  char text[32];
  std::snprintf(text, sizeof(text), "%u.%09u", stamp.sec, stamp.nsec);
  return text;
}

std::optional<ros::Time> parseStamp(const std::string& text) {
  static const std::regex pattern("([0-9]{1,10})\\.([0-9]{9})");
  std::smatch parts;
  if (!std::regex_match(text, parts, pattern)) return std::nullopt;
  const unsigned long seconds = std::stoul(parts[1].str());
  if (seconds > std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
  return ros::Time(std::uint32_t(seconds), std::uint32_t(std::stoul(parts[2].str())));
}

}  // namespace sks::tools
