// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>

#include <Eigen/Geometry>

#include <sks_detector/cloud.hpp>
#include <sks_detector/settings.hpp>

namespace sks {

/// How the scene has moved before the sensor, by the last clouds as a whole: few points of each, aligned by
/// point-to-plane ICP. It takes some ten milliseconds, so it is for where no followed object tells. Deterministic; not
/// thread-safe.
class SceneMotion {
public:
  /// Keeps few points of a cloud, and forgets what is too old.
  /// @param stamp [s], later than that of the last cloud
  void add(const Cloud& cloud, double stamp);
  void clear() { kept_.clear(); }

  /// @return T_last_then: from the frame of an earlier cloud into that of the last one; none where that one is not kept
  /// any more, or one of those between shows too little
  std::optional<Eigen::Isometry3d> since(double then, const Settings& settings) const;

private:
  struct Kept {
    double stamp;
    Cloud cloud;
  };
  std::deque<Kept> kept_;
};

}  // namespace sks
