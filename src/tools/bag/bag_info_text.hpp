// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "tools/bag/bag_report.hpp"

namespace sks::tools {

/// For people: tables of topics, clouds and frames, then the remarks.
std::string bagInfoText(const BagFile& bag, const BagReport& report);

/// The same for programs (docs/bags.md).
nlohmann::json bagInfoJson(const BagFile& bag, const BagReport& report);

}  // namespace sks::tools
