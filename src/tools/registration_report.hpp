// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <sks_detector/registration.hpp>

namespace sks::tools {

/// One object for each registered object: its frame, box, loop errors and views, with their poses or reasons.
nlohmann::json registrationJson(const std::vector<RegisteredObject>& objects);

/// One line for each object.
std::string registrationText(const std::vector<RegisteredObject>& objects);

}  // namespace sks::tools
