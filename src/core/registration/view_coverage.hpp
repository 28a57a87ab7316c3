// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <sks_detector/registration.hpp>

namespace sks {

/// From where the views of a model that stands on a plane were taken.
struct ViewCoverage {
  double share = 0;     ///< of the directions around the object that a tied view shows, in [0, 1]
  std::string missing;  ///< the others, in words, e.g. "90 to 180 degrees"; empty if there are none
};

/// Directions are turns about the plane's normal, counter-clockwise seen from above; 0 is where x points to: where the
/// first view was taken from. A view shows those within 30 degrees.
ViewCoverage coverageOf(const RegisteredObject& object);

}  // namespace sks
