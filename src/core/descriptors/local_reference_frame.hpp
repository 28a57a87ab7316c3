// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "core/descriptors/neighborhood.hpp"

namespace sks {

/// The local reference frame of SHOT (Tombari, Salti, Di Stefano 2010): eigenvectors of the covariance about the
/// keypoint, points weighted by radius - distance; x and z point to where most neighbours lie.
/// @return false if the neighbours determine no frame; else `frame` has the axes x, y, z as rows
bool localReferenceFrame(const Neighborhood& neighborhood, float radius, Eigen::Matrix3f& frame);

}  // namespace sks
