// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <sks_detector/settings.hpp>

namespace sks_detector {

/// What the camera can be told by private parameters; the one source of their defaults, ranges, units and help.
struct CameraSettings {
  std::string device;
  int width = 640;
  int height = 480;
  double rate = 30.0;
  bool color = true;
  bool registration = true;
  bool sync = true;
  bool loop = true;
  double focal_length = 0.0;
  double center_x = 0.0;
  double center_y = 0.0;
  std::string frame_id = "camera_rgb_optical_frame";
  bool always_on = false;
  double frame_timeout = 5.0;
  double retry_delay = 0.5;
  double max_retry_delay = 5.0;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    using sks::Range;
    v(s.device, "device",
      "which camera: its URI, \"#1\" for the first in the list, its serial number, or an .oni file that is played; "
      "empty: the first");
    v(s.width, "width", Range{1, 10000}, "px", "width of the depth image; the nearest mode of the device is used");
    v(s.height, "height", Range{1, 10000}, "px", "height of the depth image; the nearest mode of the device is used");
    v(s.rate, "rate", Range{1, 1000}, "Hz", "frame rate; the nearest of the device's at that size is used");
    v(s.color, "color", "use the colour camera where the device has one");
    v(s.registration, "registration", "let the device map depth to the colour image where it can");
    v(s.sync, "sync", "let the device take depth and colour at the same time where it can");
    v(s.loop, "loop", "play an .oni file again and again, not once");
    v(s.focal_length, "focal_length", Range{0, 100000}, "px",
      "focal length of the depth image at the size that is published; 0: computed from the device's field of view");
    v(s.center_x, "center_x", Range{0, 10000}, "px",
      "column of the depth image that the optical axis meets; 0: the middle");
    v(s.center_y, "center_y", Range{0, 10000}, "px",
      "row of the depth image that the optical axis meets; 0: the middle");
    v(s.frame_id, "frame_id", "frame of all messages: optical, that is z forward, x right, y down");
    v(s.always_on, "always_on", "let the camera run also while nobody has subscribed to its images");
    v(s.frame_timeout, "frame_timeout", Range{0.1, 3600}, "s",
      "a camera that gives no frame for this time is taken as gone and opened again");
    v(s.retry_delay, "retry_delay", Range{0.01, 3600}, "s",
      "pause before the first attempt to open a camera that is gone; it doubles with each further attempt");
    v(s.max_retry_delay, "max_retry_delay", Range{0.01, 3600}, "s",
      "longest pause between two attempts to open a camera that is gone");
  }
};

}  // namespace sks_detector
