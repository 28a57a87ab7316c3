// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sks_detector/stages/surface.hpp>

#include "core/surface/sanitize.hpp"

namespace sks::test {

/// A cloud as the stages after the surface see it, with default settings.
inline Surface prepared(const Cloud& cloud, Orientation orientation = Orientation::sensor) {
  return prepareSurface(sanitize(cloud, SanitizeSettings()), SurfaceSettings(), orientation, 2);
}

}  // namespace sks::test
