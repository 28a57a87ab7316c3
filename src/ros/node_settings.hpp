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
  std::string tf_prefix;
  std::string tf_frame = "{object}";
  bool tracking = false;
  std::string fixed_frame;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    using sks::Range;
    v(s.codebook, "codebook",
      "codebook file that is loaded when the node starts; empty: none, and nothing is detected until a service loads "
      "or "
      "trains one");
    v(s.codebook_directory, "codebook_directory",
      "folder that services load codebooks from and save them to; empty: that of ~codebook, else ~/.ros/sks_detector");
    v(s.dataset_directory, "dataset_directory",
      "folder that services train from and keep captured views in; empty: ~/.ros/sks_detector/datasets");
    v(s.target_frame, "target_frame",
      "frame in which detections are published, e.g. map; empty: the frame of the cloud");
    v(s.sensor_frame, "sensor_frame",
      "frame of the camera, looking along z; set it where clouds come in another frame, e.g. base_link; empty: clouds "
      "are in the frame of the camera");
    v(s.tf_timeout, "tf_timeout", Range{0, 60}, "s",
      "longest wait for the transforms to target_frame and sensor_frame; a cloud whose transforms come later is not "
      "used; larger: late transforms are waited for, but each wait delays detection");
    v(s.max_input_age, "max_input_age", Range{0, 3600}, "s",
      "clouds whose stamp is older than this are dropped; 0: none are dropped");
    v(s.max_points, "max_points", Range{1, 100000000}, "",
      "clouds with more points are refused with an error: they would take minutes");
    v(s.silence_warning, "silence_warning", Range{0, 3600}, "s",
      "time without a cloud after which the node warns; 0: it never warns");
    v(s.service_timeout, "service_timeout", Range{0.1, 3600}, "s",
      "longest time that a service waits for the next cloud before it fails");
    v(s.always_on, "always_on", "detect in every cloud, also while nobody has subscribed to the results");
    v(s.publish_tf, "publish_tf", "broadcast the pose of each detection as a transform (tf)");
    v(s.tf_prefix, "tf_prefix",
      "put before the frame of each detection, with a slash between; set it where several detectors broadcast, or the "
      "frames of one object have two parents; empty: none");
    v(s.tf_frame, "tf_frame",
      "frame of each detection; {object} stands for its name, {number} for 1, 2 ... of one object in a cloud; without "
      "{number} the second is called mug_2 and so on");
    v(s.tracking, "tracking",
      "follow objects from cloud to cloud, at the rate of the camera, and search for new ones beside it (tracker.*); "
      "else every cloud is searched anew");
    v(s.fixed_frame, "fixed_frame",
      "frame in which things stand still while the camera moves, e.g. odom: for ~tracking, and for ~capture_view where "
      "the camera is moved around the object; empty: objects are followed in the frame of the cloud, and captured "
      "views "
      "tell by themselves how they belong together");
  }
};

}  // namespace sks_detector
