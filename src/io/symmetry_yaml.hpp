// SPDX-License-Identifier: BSD-3-Clause
// Symmetries of objects in data set files.
#pragma once

#include <optional>
#include <string>

#include <Eigen/Geometry>

#include "io/symmetry.hpp"
#include "io/yaml_map.hpp"

namespace sks {

/// The value of the key `symmetry`: axis and order. @throws Error(bad_data) naming file, line and key
Symmetry readSymmetry(const YamlMap& entry);

/// The values of the keys `symmetries_discrete` and `symmetries_continuous`; nothing where neither is there.
/// @param scale metres in a unit of the entry @throws Error(bad_data) naming file, line and key
std::optional<ObjectSymmetries> readSymmetries(const YamlMap& entry, double scale);

/// A rigid motion from 16 numbers, row-major, in the units of the file. @throws Error(bad_data) for any other matrix
Eigen::Isometry3d readRigidMotion(const YamlMap& map, const std::string& key);

}  // namespace sks
