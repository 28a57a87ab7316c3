// SPDX-License-Identifier: BSD-3-Clause
// Clouds of PCL. Nothing else of this package needs this header; who includes it needs PCL.
#pragma once

#include <cstdint>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <sks_detector/cloud.hpp>
#include <sks_detector/detection.hpp>
#include <sks_detector/detector.hpp>

namespace sks {

/// A copy of a PCL cloud in metres: positions (NaN stays), rows and columns, the sensor's position, and colours where
/// the points have some. Normals are not taken over.
/// @tparam PointT with x, y, z; colours of those with rgb or rgba: PointXYZ, PointXYZRGB, PointXYZRGBA,
///         PointXYZRGBNormal and the like
template <typename PointT>
Cloud fromPcl(const pcl::PointCloud<PointT>& from) {
  Cloud cloud;
  cloud.width = from.width;
  cloud.height = from.height;
  cloud.sensor_origin = from.sensor_origin_.template head<3>();
  cloud.points.reserve(from.size());
  for (const PointT& point : from.points) cloud.points.emplace_back(point.x, point.y, point.z);
  if constexpr (pcl::traits::has_color<PointT>::value) {
    cloud.colors.reserve(from.size());
    for (const PointT& point : from.points) cloud.colors.push_back({point.r, point.g, point.b});
  }
  return cloud;
}

/// Detector::detect() in a PCL cloud: in metres, seen from its sensor_origin_. The result is in the frame of the cloud.
/// @throws like Detector::detect()
template <typename PointT>
DetectionResult detect(const Detector& detector, const pcl::PointCloud<PointT>& cloud) {
  return detector.detect(fromPcl(cloud));
}

}  // namespace sks
