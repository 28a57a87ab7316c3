// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <istream>
#include <string>

#include <sks_detector/cloud.hpp>

namespace sks {

/// Compares what a PLY header says of the vertices with the length of the file; the stream stands at its start.
/// @return number of vertices
/// @throws Error(bad_data)
std::uint64_t checkPlyHeader(std::istream& file, std::uint64_t file_size);

/// The vertices of a PLY file whose header has been checked, read by PCL. @throws Error(bad_data)
Cloud readPly(const std::string& path, double scale);

}  // namespace sks
