// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include <sks_detector/cloud.hpp>

namespace sks {

/// sRGB (D65) to CIELab, scaled to L / 100, a / 120, b / 120 as CSHOT compares colours.
std::array<float, 3> toScaledLab(const Rgb& color);

/// Its inverse, to the nearest colour that sRGB has.
Rgb fromScaledLab(const std::array<float, 3>& color);

}  // namespace sks
