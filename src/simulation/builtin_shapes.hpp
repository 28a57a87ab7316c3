// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sks_detector/simulation/mesh.hpp>

namespace sks {

Mesh makeMug();         ///< with a handle, a coloured band and an emblem opposite of the handle
Mesh makeBottle();      ///< with a cap and a label on one side
Mesh makeBowl();        ///< a body of revolution
Mesh makePrintedBox();  ///< a carton whose faces are printed differently
Mesh makeDrill();       ///< a cordless drill
Mesh makeDuck();        ///< a toy

}  // namespace sks
