// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace sks {

/// The file that `path` names, if it lies inside `directory` once all symbolic links are resolved: for names that come
/// from elsewhere, over a network. Neither needs to exist. Against someone who changes links in the directory
/// meanwhile there is no protection.
/// @param path relative to `directory`, or absolute
/// @return absolute and free of links, `.` and `..`: use this one, not `path`
/// @throws Error(bad_usage) naming both: outside of the directory, the directory itself, empty, too long, not a name
std::string confinedPath(const std::string& path, const std::string& directory);

/// Checks that a name is fit for one folder or file: UTF-8 without separators or control characters, no leading dot, at
/// most 100 bytes. @param what the name is, for the message, e.g. "the object's name" @throws Error(bad_usage)
void checkFileName(const std::string& name, const std::string& what);

}  // namespace sks
