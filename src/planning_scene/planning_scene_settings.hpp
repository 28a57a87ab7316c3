// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sks_detector/settings.hpp>

namespace sks_detector {

/// What planning_scene_node can be told by private parameters; the one source of their defaults, ranges, units and
/// help.
struct PlanningSceneSettings {
  double min_score = 0.5;
  int add_after = 3;
  double remove_after = 3.0;
  double min_shift = 0.005;
  double min_turn = 0.05;
  bool support = true;
  double support_thickness = 0.02;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    using sks::Range;
    v(s.min_score, "min_score", Range{0, 1}, "", "detections with a lower score are passed over");
    v(s.add_after, "add_after", Range{1, 1000}, "frames",
      "an object is added once it was seen in so many frames, one after the other");
    v(s.remove_after, "remove_after", Range{0, 3600}, "s",
      "an object is removed when the frames of this time did not show it; no frames, no time");
    v(s.min_shift, "min_shift", Range{0, 1}, "m", "an object that moved or grew by less stays as it is in the scene");
    v(s.min_turn, "min_turn", Range{0, 3.2}, "rad", "an object that turned by less stays as it is in the scene");
    v(s.support, "support", "also add what the objects stand on, as the object `support`");
    v(s.support_thickness, "support_thickness", Range{0.001, 2}, "m", "of the box below the supporting plane");
  }
};

}  // namespace sks_detector
