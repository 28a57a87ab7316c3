// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/simulation/camera_model.hpp>
#include <sks_detector/simulation/mesh.hpp>

#include "simulation/renderer.hpp"
#include "simulation/room.hpp"

namespace sks {

/// Something that scenes can be made of.
struct SceneModel {
  std::string object;  ///< name
  std::string source;  ///< what its mesh is called
  std::shared_ptr<const Mesh> mesh;
};

/// How scenes are made.
struct SceneOptions {
  int objects = 5;        ///< in a scene
  bool repeated = false;  ///< an object may be there several times even where there are enough different ones
  int distractors = 4;    ///< boxes, balls and cylinders that are no objects
  bool packages = false;  ///< distractors are packages with prints instead
  Room room = Room::plain;
  double region = 0.20;     ///< radius of the circle on the table over which things are dropped [m]
  double wall_share = 0.5;  ///< of the scenes with a plain room, a wall stands behind the table
  double min_distance = 0.7, max_distance = 1.3;  ///< of the camera from the middle of the table [m]
  double min_elevation = 25, max_elevation = 60;  ///< of the camera above the table [deg]
  std::uint64_t seed = 1;
  CameraModel camera;
  int threads = 2;
};

/// An object in a scene.
struct ScenePlacement {
  std::size_t model = 0;                                             ///< index into the models
  Eigen::Isometry3d T_camera_model = Eigen::Isometry3d::Identity();  ///< exact, camera's optical frame
  double visibility = 0;  ///< pixels of it that are seen / pixels that would be seen were it alone; 0 outside the image
  std::size_t points = 0;  ///< of the cloud that lie on it
};

/// A cluttered table as the camera sees it.
struct SimulatedScene {
  Rendering view;
  std::vector<ScenePlacement> objects;
  Eigen::Isometry3d T_table_camera = Eigen::Isometry3d::Identity();  ///< table: z upwards, origin in its middle
};

/// Drops objects on a table until they lie still, and looks at them. Scenes are independent of each other: same models,
/// options and number, same scene.
/// @throws Error(bad_usage) for impossible options
SimulatedScene simulateScene(const std::vector<SceneModel>& models, const SceneOptions& options, std::uint64_t number);

/// Refuses impossible options. @throws Error(bad_usage) naming the value and its range
void validate(const SceneOptions& options);

}  // namespace sks
