// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include <sks_detector/codebook.hpp>

namespace sks {

/// The content of the file that writeCodebook() would write. @throws Error(bad_file) if the codebook cannot be stored
std::string codebookBytes(const Codebook& codebook);

/// The codebook that readCodebook() would read from a file with this content. @throws Error(bad_file)
std::shared_ptr<const Codebook> codebookFromBytes(const std::string& bytes);

}  // namespace sks
