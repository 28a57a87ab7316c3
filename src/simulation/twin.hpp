// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/cloud.hpp>
#include <sks_detector/simulation/camera_model.hpp>
#include <sks_detector/simulation/mesh.hpp>

namespace sks {

/// An object of a recording whose pose is known.
struct TwinObject {
  std::shared_ptr<const Mesh> mesh;
  Eigen::Isometry3d T_camera_mesh = Eigen::Isometry3d::Identity();  ///< camera's optical frame
};

/// A recording whose objects were replaced by their meshes.
struct Twin {
  Cloud cloud;                      ///< organised as the recording
  std::vector<std::size_t> points;  ///< how many of the cloud lie on each object's mesh
};

/// Replaces the objects of a recording by their meshes, as a virtual camera sees them from where the recording was
/// made: with the recording's intrinsics, and with the exposure and white balance that fit its colours. What stands
/// before them and around them stays as recorded.
/// @param recording organised, camera at the origin, seen along z [m]
/// @param camera its errors, in the pixels of its own focal length @param frame number of the picture
/// @throws Error(bad_data) if the recording is not organised, or no pinhole camera saw it
Twin makeTwin(const Cloud& recording, const std::vector<TwinObject>& objects, const CameraModel& camera,
              std::uint64_t frame, int threads);

}  // namespace sks
