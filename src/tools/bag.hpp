// SPDX-License-Identifier: BSD-3-Clause
// What the command line needs of ROS bags. Where ROS is left out of the build, these say what is missing.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <CLI/App.hpp>

#include <sks_detector/cloud.hpp>
#include <sks_detector/detection.hpp>
#include <sks_detector/simulation/camera_model.hpp>

namespace sks::tools {

void addBag(CLI::App& app);

/// Records what a virtual camera sees, with the truth, for `rosbag play`. Same frames, same file, byte for byte.
/// Topics: /camera/depth_registered/points, /camera/rgb/camera_info, /ground_truth (sks_detector/DetectionArray) and
/// /tf (table -> camera_rgb_optical_frame), all with the stamp of their frame.
class BagRecorder {
public:
  /// @param rate frames a second
  /// @throws Error(bad_usage) for an impossible rate or without ROS, Error(bad_file)
  BagRecorder(const std::string& path, const CameraModel& camera, double rate);
  ~BagRecorder();  ///< removes what finish() did not complete

  /// @param truth what stands there, in the camera's frame; the score is the visible fraction @throws Error(bad_file)
  void add(const Cloud& cloud, const Eigen::Isometry3d& T_table_camera, const std::vector<Detection>& truth);

  /// Gives the file its name. @throws Error(bad_file)
  void finish();

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sks::tools
