// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include <sks_detector/codebook.hpp>

namespace sks::tools {

/// What a codebook holds, for people: a line on the file and a table of its objects.
std::string codebookTable(const std::string& path, const Codebook& codebook);

/// Keys file, name, checksum, bytes, descriptor_type, descriptor_size, training_clouds, codewords, objects, settings.
nlohmann::json codebookJson(const std::string& path, const Codebook& codebook);

/// The checksum by which a codebook is known, eight hexadecimal digits.
std::string checksumText(const Codebook& codebook);

}  // namespace sks::tools
