// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "planning_scene/planning_scene_settings.hpp"

namespace sks_detector {

/// A box, in the frame of the scene.
struct SceneBox {
  Eigen::Isometry3d T_scene_box = Eigen::Isometry3d::Identity();  ///< its centre, and axes
  Eigen::Vector3d size = Eigen::Vector3d::Zero();                 ///< full extents along its axes [m]
};

/// Angle between two boxes, which look the same after half a turn about an axis of theirs, in [0, pi] [rad].
double turnBetween(const SceneBox& a, const SceneBox& b);

/// What one frame shows of an object.
struct SeenObject {
  std::uint32_t track = 0;  ///< the same in every frame that shows the object; 0: it was not followed
  std::string name;
  SceneBox box;
};

/// What is in the scene.
struct SceneObject {
  std::string id;    ///< "object_1", "object_2" ..., never used again; "support"
  std::string name;  ///< of the trained object; empty for the support
  SceneBox box;
};

/// What one frame changes.
struct SceneChange {
  std::vector<SceneObject> put;      ///< new, or moved
  std::vector<std::string> removed;  ///< ids

  bool empty() const { return put.empty() && removed.empty(); }
};

/// What is to be in a planning scene, with hysteresis: objects come once several frames have shown them, go once frames
/// no longer show them for a while, and move only where they moved for certain. For one thread.
class SceneObjects {
public:
  explicit SceneObjects(const PlanningSceneSettings& settings) : settings_(settings) {}

  /// @param stamp of the frame [s]; one that is older than the last lets no time pass
  SceneChange takeObjects(double stamp, const std::vector<SeenObject>& seen);
  /// @param seen nothing where the frame shows no support
  SceneChange takeSupport(double stamp, const std::optional<SceneBox>& seen);

  /// Forgets everything. @return the removal of what was in the scene
  SceneChange clear();

  /// All that is in the scene.
  std::vector<SceneObject> all() const;

private:
  struct Entry {
    SceneObject object;  // without an id it is not in the scene yet
    std::uint32_t track = 0;
    SceneBox last;  // as the last frame showed it
    int frames = 0;
    double seen_at = 0;  // [s]
    bool fresh = true;   // the frame at hand shows it
  };

  std::vector<std::optional<std::size_t>> match(const std::vector<SeenObject>& seen) const;
  bool countsAsMoved(const Entry& entry, double min_growth) const;
  void show(Entry& entry, const SeenObject& seen, double stamp) const;

  PlanningSceneSettings settings_;
  std::vector<Entry> entries_;
  std::optional<Entry> support_;
  std::uint64_t next_number_ = 1;
};

}  // namespace sks_detector
