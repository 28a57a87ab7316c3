// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace sks {

/// Whether a text is UTF-8 (RFC 3629) of characters that may be interchanged: no surrogates, no noncharacters. Only
/// such text survives YAML files and ROS messages unchanged.
bool isUtf8(const std::string& text);

}  // namespace sks
