// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <sks_detector/simulation/mesh.hpp>

#include "io/symmetry.hpp"

namespace sks {

/// The symmetry under which a mesh, rotated about the centre of its box, falls on itself in shape and, where it has
/// colour, in colour: to a few millimetres on nearly all of its surface. Axes along those of the model frame and along
/// the principal ones are tried; a body of revolution comes before the highest order up to 8.
std::optional<Symmetry> estimateSymmetry(const Mesh& mesh);

}  // namespace sks
