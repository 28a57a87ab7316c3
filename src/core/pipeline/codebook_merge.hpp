// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <sks_detector/codebook.hpp>

namespace sks {

/// A codebook that is to be joined with others.
struct CodebookPart {
  std::string label;                         ///< what messages call it, e.g. its file
  std::shared_ptr<const Codebook> codebook;  ///< not null
};

/// What training would have made of the samples of all parts, one part after the other: the same codebook, and so the
/// same file, where `descriptor.type` was not `auto`, or was decided alike in all parts.
/// @param parts at least one @param name of the result
/// @throws Error(incompatible) naming what differs from the first part: keys and values of settings (whatever the
/// number
///         of threads), descriptors of a stage of the user's; or the objects that two parts hold
Codebook mergedCodebook(const std::vector<CodebookPart>& parts, const std::string& name);

}  // namespace sks
