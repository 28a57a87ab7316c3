// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "evaluation/evaluation.hpp"
#include "io/dataset.hpp"

namespace sks::tools {

/// Refuses data sets whose scenes and objects have no numbers of the BOP challenge: scenes are called
/// `<scene>/<image>` and objects `obj_<number>` or `<number>`, as `sks import bop` calls them.
/// @throws Error(bad_data) naming the scene or object
void checkBopNames(const DataSet& data_set);

/// Every detection of every score, in the result file format of the BOP challenge:
/// scene_id,im_id,obj_id,score,R,t,time with R row-major, t in millimetres and the time of the whole image in seconds.
/// @throws Error(bad_data) for a detection whose pose is not in the frame of a mesh of the data set
std::string bopResults(const DataSet& data_set, const Evaluation& evaluation);

}  // namespace sks::tools
