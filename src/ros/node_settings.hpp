// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <sks_detector/settings.hpp>

namespace sks_detector {

/// What the node itself can be told by private parameters, beside the detector's settings. The one source of their
/// defaults, ranges, units and help, like sks::Settings.
struct NodeSettings {
  std::string codebook;
  std::string codebook_directory;
  std::string dataset_directory;
  std::string target_frame;
  std::string sensor_frame;
  double tf_timeout = 0.2;
  double max_input_age = 0.0;
  int max_points = 2000000;
  double silence_warning = 5.0;
  double service_timeout = 10.0;
  bool always_on = false;
  bool publish_tf = false;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    using sks::Range;
    v(s.codebook, "codebook", "codebook file that is loaded at the start; empty: none");
    v(s.codebook_directory, "codebook_directory",
      "folder that services load codebooks from and save them to; empty: that of ~codebook, else ~/.ros/sks_detector");
    v(s.dataset_directory, "dataset_directory",
      "folder that services train from and keep captured views in; empty: ~/.ros/sks_detector/datasets");
    v(s.target_frame, "target_frame", "frame of the detections; empty: that of the cloud");
    v(s.sensor_frame, "sensor_frame",
      "frame of the camera, where clouds come in another frame, e.g. base_link; empty: that of the cloud");
    v(s.tf_timeout, "tf_timeout", Range{0, 60}, "s",
      "longest wait for the transforms of ~target_frame and ~sensor_frame");
    v(s.max_input_age, "max_input_age", Range{0, 3600}, "s", "older clouds are dropped; 0: none");
    v(s.max_points, "max_points", Range{1, 100000000}, "", "clouds with more points are refused");
    v(s.silence_warning, "silence_warning", Range{0, 3600}, "s", "a warning after so long without a cloud; 0: never");
    v(s.service_timeout, "service_timeout", Range{0.1, 3600}, "s", "longest wait of a service for the next cloud");
    v(s.always_on, "always_on", "process clouds even while nobody listens");
    v(s.publish_tf, "publish_tf", "broadcast the pose of each detection as a transform");
  }
};

}  // namespace sks_detector
