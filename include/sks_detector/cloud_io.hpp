// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <sks_detector/cloud.hpp>

namespace sks {

/// Reads a PCD or PLY file (ascii, binary, compressed; float or double coordinates; rgb, rgba or red/green/blue).
/// @param scale factor from the file's unit to metres (0.001 for millimetres)
/// @throws Error(bad_file) naming the file and what is wrong with it: missing, foreign, truncated, no x/y/z
Cloud readCloud(const std::string& path, double scale = 1.0);

/// Writes a binary PCD file (x y z, and rgb where the cloud has colour) to a temporary name, syncs and renames it.
/// @throws Error(bad_file)
void writeCloud(const std::string& path, const Cloud& cloud);

}  // namespace sks
