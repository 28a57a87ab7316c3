// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sks_detector/cloud.hpp>

#include "drawing/view_camera.hpp"
#include "io/image_file.hpp"

namespace sks {

/// What the camera sees of a cloud: the nearest point at each pixel in its colour, or, without colour, shaded by the
/// surface's inclination and its depth. Small gaps between points are closed.
ColorImage renderPoints(const Cloud& cloud, const ViewCamera& camera, PictureSize size);

}  // namespace sks
