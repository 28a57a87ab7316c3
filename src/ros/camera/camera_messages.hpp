// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include "ros/camera/camera_frame.hpp"

namespace sks_detector {

/// Organised cloud of x, y, z and, where there is colour, rgb; 16 bytes a point.
sensor_msgs::PointCloud2Ptr cloudMessage(const CameraFrame& frame, const std_msgs::Header& header);

/// 16UC1 in millimetres (REP 118).
sensor_msgs::ImagePtr depthMessage(const DepthImage& image, const std_msgs::Header& header);

/// rgb8.
sensor_msgs::ImagePtr colorMessage(const ColorImage& image, const std_msgs::Header& header);

/// Of the depth image and the cloud: a pinhole camera without distortion.
sensor_msgs::CameraInfoPtr cameraInfoMessage(const CameraFrame& frame, const std_msgs::Header& header);

}  // namespace sks_detector
