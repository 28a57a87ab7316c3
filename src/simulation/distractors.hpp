// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sks_detector/simulation/mesh.hpp>

#include "simulation/pixel_random.hpp"

namespace sks {

/// A box, ball or cylinder of one colour.
Mesh plainDistractor(PixelRandom& random);

/// A thing as kitchens hold them, of the sizes of packages: carton, can, bottle, jar, book or cup, with a print.
Mesh packageDistractor(PixelRandom& random);

}  // namespace sks
