// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "simulation/renderer.hpp"

namespace sks {

/// What stands around the things of a scene.
enum class Room {
  none,       ///< nothing, not even the table
  plain,      ///< a table of one colour, in some of the scenes a wall behind it
  furnished,  ///< a table with a pattern, and behind it floor, walls, chairs, a desk with screens, a shelf: to 4 m
};

/// By name. @throws Error(bad_usage) naming those that exist
Room roomOf(const std::string& name);
/// Names of all rooms.
std::vector<std::string> roomNames();

constexpr double table_half = 0.6;  ///< of the table's edges [m]

/// Floor, walls and furniture of a furnished room, around a table whose top is z = 0. All of it stands on the side of
/// the table that is far from the camera. Same arguments, same room.
void furnish(Renderer& renderer, const Eigen::Isometry3d& T_table_camera, std::uint64_t seed, std::uint64_t number);

/// The table of a furnished room.
Mesh patternedTable(std::uint64_t seed, std::uint64_t number);

}  // namespace sks
