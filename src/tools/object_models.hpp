// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evaluation/bop_scores.hpp"
#include "io/dataset.hpp"

namespace sks::tools {

/// Loads meshes and full models of a data set, with diameter and symmetries as the data set states them; a diameter
/// that it does not state is measured. The reference to the data set is kept.
ModelLoader objectModels(const DataSet& data_set);

}  // namespace sks::tools
