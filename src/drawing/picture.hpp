// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/cloud.hpp>
#include <sks_detector/detection.hpp>

#include "drawing/canvas.hpp"
#include "drawing/view_camera.hpp"
#include "io/image_file.hpp"

namespace sks {

/// A picture of a cloud as its sensor sees it, with what was found in it; needs no display.
class Picture {
public:
  explicit Picture(const Cloud& cloud, PictureSize size = {1280, 960});

  /// The edges of an oriented box. @param box_size full extents along its axes [m]
  void drawBox(const Eigen::Isometry3d& T_cloud_box, const Eigen::Vector3d& box_size, Rgb color);

  /// Axes x red, y green, z blue. @param length [m]
  void drawAxes(const Eigen::Vector3d& origin, const Eigen::Matrix3d& axes, double length);

  /// A cross at a place, e.g. of an object that was missed.
  void drawCross(const Eigen::Vector3d& place, Rgb color);

  /// Text on a plate of the given colour just above the box, clear of earlier labels and above all lines.
  void drawLabel(const Eigen::Isometry3d& T_cloud_box, const Eigen::Vector3d& box_size, const std::string& text,
                 Rgb color);

  /// Box, the model's axes at the box's centre, and a label such as "mario 0.87".
  void drawDetection(const Detection& detection, Rgb color);

  /// What was drawn so far.
  ColorImage image() const;

  /// Writes a PNG or JPEG whole or not at all. @throws Error(bad_usage) for another ending, Error(bad_file)
  void save(const std::string& path) const;

private:
  struct Label {
    PixelBox plate;
    std::string text;
    Rgb color;
  };

  void drawEdge(const Eigen::Vector3d& from, const Eigen::Vector3d& to, Rgb color, double thickness);

  ViewCamera camera_;
  ColorImage image_;
  std::vector<Label> labels_;  // painted last
};

/// Throws now what Picture::save() would throw later. @throws Error(bad_usage), Error(bad_file)
void checkPicturePath(const std::string& path);

}  // namespace sks
