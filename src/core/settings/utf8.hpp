// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace sks {

/// Bytes of the UTF-8 character (RFC 3629) that begins at an index of a text; 0 where none does. Surrogates and
/// noncharacters are none: they may not be interchanged.
std::size_t characterSize(const std::string& text, std::size_t begin);

/// Where the first byte is that belongs to no such character; the size of the text where there is none.
std::size_t firstNoUtf8(const std::string& text);

/// Whether a text is UTF-8 throughout. Only such text survives YAML files and ROS messages unchanged.
bool isUtf8(const std::string& text);

/// Whether a control character (U+0000 to U+001F, U+007F to U+009F) begins at an index.
bool isControl(const std::string& text, std::size_t begin);

/// Whether there is one anywhere in a text.
bool hasControl(const std::string& text);

}  // namespace sks
