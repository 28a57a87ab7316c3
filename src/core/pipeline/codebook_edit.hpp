// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include <sks_detector/codebook.hpp>

namespace sks {

/// A copy of the codebook without an object, its views and its codewords; null if nothing would be left.
/// @throws Error(bad_usage) naming the nearest known object if the codebook does not hold it
std::shared_ptr<Codebook> withoutObject(const Codebook& codebook, const std::string& object);

}  // namespace sks
