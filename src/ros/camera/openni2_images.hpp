// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OpenNI.h>

#include "ros/camera/camera_frame.hpp"

namespace sks_detector {

/// Copies a depth image of whole or tenths of millimetres. @param mirrored the driver gives it so: turned back
DepthImage depthImage(const openni::VideoFrameRef& frame, bool mirrored);

/// Copies a colour image of 24 bits a pixel. @param mirrored the driver gives it so: turned back
ColorImage colorImage(const openni::VideoFrameRef& frame, bool mirrored);

}  // namespace sks_detector
