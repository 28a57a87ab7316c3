// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <sks_detector/cloud.hpp>

namespace sks::tools {

/// Triangles of an OFF file.
struct OffMesh {
  std::vector<Eigen::Vector3f> vertices;                ///< in the file's units
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< polygons are cut into fans
};

/// Reads an OFF file (ascii). Other readers refuse those of ModelNet whose first line runs into the second one:
/// "OFF123 45 0". Comments, colours and counts of edges are skipped.
/// @throws Error(bad_file) naming the file, its line and what is wrong
OffMesh readOff(const std::string& path);

/// Points spread evenly over the surface of a mesh, scaled so that their box has the given diagonal and centred at the
/// origin. Same mesh, same points. @throws Error(bad_data) for a mesh without area
Cloud sampleMesh(const OffMesh& mesh, int points, double diagonal);

}  // namespace sks::tools
