// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sks_detector/codebook.hpp>

#include "io/dataset.hpp"

namespace sks {

/// The data set with the ground truth also in the model frames of the codebook: where the reference of an instance is a
/// view that was registered, its pose in the scene gives that of the model.
DataSet registeredTruth(DataSet data_set, const Codebook& codebook);

}  // namespace sks
