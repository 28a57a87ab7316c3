// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace sks {

/// Otsu's threshold between the flat and the curved: the cut of the histogram of log(value) over positive values that
/// maximises the variance between its two sides. Values of curvature spread over decades, hence the logarithm.
/// 0 where fewer than two different positive values are given.
double otsuThreshold(const std::vector<float>& values);

}  // namespace sks
