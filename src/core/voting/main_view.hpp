// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <sks_detector/codebook.hpp>

namespace sks {

/// The view to which most of the codewords belong; of equals the first. @param words indices, at least one
std::uint32_t mainView(const Codebook& codebook, const std::vector<std::uint32_t>& words);

}  // namespace sks
