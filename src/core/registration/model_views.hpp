// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <sks_detector/registration.hpp>

namespace sks {

/// Views of the model of an object as samples for train(), from directions between those that it was captured from and
/// as far away: captured views lie farther apart than those that a mesh is trained with, and each has the noise of one
/// picture. Each is in the frame of the captured view nearest to it, so that what is cut off there is cut off here, and
/// called `object#model/0`, `object#model/1` ... None where nothing was registered, or too coarsely for normals.
std::vector<TrainingSample> modelSamples(const RegisteredObject& object, const Settings& settings);

}  // namespace sks
