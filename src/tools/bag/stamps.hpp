// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include <ros/time.h>

namespace sks::tools {

/// Seconds and nine digits, e.g. "1527240258.000000500": names of scenes and files that are cut out of bags.
std::string stampText(const ros::Time& stamp);

/// The other way round; nothing where the text is no stamp.
std::optional<ros::Time> parseStamp(const std::string& text);

}  // namespace sks::tools
