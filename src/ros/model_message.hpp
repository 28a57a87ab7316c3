// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <sks_detector/ObjectModels.h>

#include <sks_detector/codebook.hpp>

namespace sks_detector {

/// The surface of each object in each of its model frames, thinned to a spacing of 5 mm, or as much more as keeps all
/// of them below about 8 MB and each below about 48 kB. The header is left empty.
/// @param name of the codebook, with its checksum
ObjectModels toModels(const sks::Codebook& codebook, const std::string& name);

}  // namespace sks_detector
