// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace sks_detector {

struct VideoMode {
  int width = 0;      ///< [px]
  int height = 0;     ///< [px]
  double rate = 0.0;  ///< [Hz]
};

/// E.g. "640x480 at 30 Hz".
std::string toText(const VideoMode& mode);

/// Index of the mode nearest in size and, among those, in rate; the first of equals. `modes` must not be empty.
std::size_t nearestMode(const std::vector<VideoMode>& modes, const VideoMode& wanted);

}  // namespace sks_detector
