// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include <sks_detector/codebook.hpp>

#include "core/verification/body_axis.hpp"

namespace sks {

/// All that is known of an object's surface in one model frame: what its registered views saw together. Of a view with
/// a frame of its own: what that view saw.
struct ModelSurface {
  std::vector<Eigen::Vector3f> points;      ///< [m], model frame; about one for each cube of `resolution`
  std::vector<Eigen::Vector3f> normals;     ///< unit
  std::vector<Eigen::Vector3f> colors;      ///< as in Surface; empty without colour
  float resolution = 0;                     ///< [m]
  std::optional<BodyAxis> body;             ///< of a surface that several views saw, if it has one
  std::vector<std::uint32_t> views;         ///< that it is made of: indices into Codebook::views
  std::vector<Eigen::Vector3f> centers;     ///< of the boxes of these views [m]
  std::vector<Eigen::Vector3f> directions;  ///< unit vectors from there to the sensors that took them
};

/// For each view of the codebook the surface in its frame; views of one object and frame share one. The same for any
/// number of threads.
std::vector<std::shared_ptr<const ModelSurface>> modelSurfaces(const Codebook& codebook, int threads = 1);

}  // namespace sks
