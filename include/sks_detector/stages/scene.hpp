// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/stages/descriptors.hpp>
#include <sks_detector/stages/keypoints.hpp>
#include <sks_detector/stages/large_planes.hpp>
#include <sks_detector/stages/matching.hpp>
#include <sks_detector/stages/surface.hpp>
#include <sks_detector/stages/voting.hpp>

namespace sks {

/// Where an object is known to be.
struct OccupiedBox {
  Eigen::Isometry3d T_scene_box = Eigen::Isometry3d::Identity();
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< full extents [m]

  bool contains(const Eigen::Vector3d& position) const {
    return ((T_scene_box.inverse() * position).cwiseAbs().array() <= 0.5 * size.array()).all();
  }
};

/// A scene on its way from the cloud to its votes, in the frame of the cloud [m].
struct SceneDescription {
  Surface surface;
  std::vector<LargePlane> planes;        ///< found where the settings need them
  std::vector<OccupiedBox> occupied;     ///< nothing is looked for there
  Keypoints keypoints;                   ///< those that the selection kept
  Descriptors descriptors;               ///< of those keypoints that could be described
  std::vector<Match> matches;            ///< in the order of the descriptors
  std::vector<std::vector<Vote>> votes;  ///< one Hough space for each object of the codebook
};

}  // namespace sks
