// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace sks {

/// Bytes of the name of an object, scene, data set or codebook at most: names ride on every detection.
constexpr std::size_t longest_name = 200;

/// Why a name cannot be used; empty if it can: UTF-8 of 1 to 200 bytes without control characters.
std::string nameFault(const std::string& name);

/// @param what the name is, for the message, e.g. "the object's name" @throws Error(bad_usage)
void checkName(const std::string& name, const std::string& what);

}  // namespace sks
