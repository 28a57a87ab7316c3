// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Geometry>

#include "simulation/pixel_random.hpp"
#include "simulation/renderer.hpp"
#include "simulation/scene.hpp"

namespace sks {

/// Something on the table.
struct TableThing {
  std::shared_ptr<const Mesh> mesh;
  int model = -1;  ///< index into the models; -1: it is no object
  Eigen::Isometry3d T_table_thing = Eigen::Isometry3d::Identity();
};

/// A table with things that were dropped on it, to be looked at from anywhere: what scenes and sequences are made of.
/// Same arguments and calls, same pictures.
class TableStage {
public:
  /// Drops objects and other things until they lie still.
  /// @throws Error(bad_usage) for impossible options, or without models
  TableStage(const std::vector<SceneModel>& models, const SceneOptions& options, std::uint64_t number);

  /// The things first, each an instance of the same number.
  const std::vector<TableThing>& things() const { return things_; }
  PixelRandom& random() { return random_; }

  /// What stands around the table, and walls that a camera there sees.
  void addRoom(const Eigen::Isometry3d& T_table_camera);
  /// One thing more, that is no object; hidden until it is moved. @return its number among the instances
  std::size_t addProp(std::shared_ptr<const Mesh> mesh);
  void moveInstance(std::size_t instance, const Eigen::Isometry3d& T_table_mesh);
  void hideInstance(std::size_t instance);

  /// @param picture number of the picture, which chooses its noise; exposure and light are those of the stage
  SimulatedScene look(const Eigen::Isometry3d& T_table_camera, std::uint64_t picture);

private:
  std::vector<std::size_t> pixelCounts(const Rendering& view, bool measured = false) const;
  std::vector<double> visibilities(const Eigen::Isometry3d& T_table_camera, const Rendering& view);
  void addPlainRoom(const Eigen::Isometry3d& T_table_camera);

  SceneOptions options_;
  std::uint64_t number_;
  PixelRandom random_;
  std::vector<TableThing> things_;
  Renderer renderer_;
  std::vector<char> visible_;  // of each instance
};

}  // namespace sks
