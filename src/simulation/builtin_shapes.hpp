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

// Small: 30 to 40 mm.
Mesh makeDice();      ///< a cube, each face with another colour and number of pips
Mesh makeBall();      ///< striped, with a patch
Mesh makeMatchbox();  ///< printed
Mesh makeSpool();     ///< of thread: two discs and a waist
Mesh makePawn();      ///< of a board game

// Flat: 6 mm high, the two faces printed differently.
Mesh makeCard();     ///< 50 x 80 mm
Mesh makeCoaster();  ///< round, 100 mm
Mesh makeTile();     ///< 120 x 120 mm
Mesh makeBooklet();  ///< 150 x 200 mm
Mesh makeTablet();   ///< 130 x 180 mm, a screen

// Thin: 13 mm at their thickest, along x.
Mesh makeMarker();       ///< 150 mm, with a cap
Mesh makeScrewdriver();  ///< 220 mm, a thin shaft
Mesh makeBrush();        ///< 250 mm, bristles at the end
Mesh makeSpoon();        ///< 300 mm, flat head of 40 mm
Mesh makeStick();        ///< 400 mm, square, with bands

}  // namespace sks
