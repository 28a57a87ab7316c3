// SPDX-License-Identifier: BSD-3-Clause
// Text from outside (names of files, fields and objects, keys, values) on its way into messages, logs and replies.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace sks {

/// The text on one line, as UTF-8: control characters and bytes that are no UTF-8 stand as \n, \t or \x1b. What is
/// longer loses its middle, so that begin and end can be read. Text that is fit already comes back unchanged.
/// @param most bytes of the result, at least 40
std::string shown(const std::string& text, std::size_t most = 200);

/// Names separated by commas; of many the first ones and how many more there are.
std::string shownList(const std::vector<std::string>& names);

/// What Error does with its message: as shown(), but long enough for a message with several names in it.
std::string shownMessage(const std::string& message);

}  // namespace sks
