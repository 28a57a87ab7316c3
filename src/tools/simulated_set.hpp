// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <sks_detector/detection.hpp>

#include "io/dataset.hpp"
#include "simulation/scene.hpp"
#include "tools/force_option.hpp"

namespace sks::tools {

/// A folder that is filled with simulated scenes: scenes/scene000.pcd with its pictures, and dataset.yaml at the end.
class SimulatedSet {
public:
  /// @param least_points objects on which fewer were measured are ignored
  /// The folder is made by the process that leads. @throws Error(bad_file) if it cannot be made
  SimulatedSet(const std::string& folder, const std::vector<TrainingEntry>& training,
               const std::vector<SceneModel>& models, std::size_t least_points = 0);

  /// Writes and lists the next scene, and where and when it was taken, for camera.txt.
  void add(const SimulatedScene& scene, double stamp);

  /// Writes cloud, colour picture (PNG) and depth picture (16-bit PNG, mm). @throws Error(bad_file)
  /// @return the scene for list()
  std::string write(const SimulatedScene& scene, std::size_t number) const;
  /// Lists a scene that was written, after those that are listed already.
  void list(const std::string& written);

  /// What stands in a scene, in the camera's frame: model frames, boxes, and the share that is seen as the score.
  std::vector<Detection> truth(const SimulatedScene& scene) const;

  /// Writes dataset.yaml and, if there are stamps, camera.txt. @return its path @throws Error(bad_file), and what
  /// ForceOption::write() throws
  std::string finish(const ForceOption& force) const;

private:
  std::string folder_;
  std::vector<std::string> sources_;        // of the models, relative to the folder
  std::vector<std::string> objects_;        // names of the models
  std::vector<Eigen::AlignedBox3d> boxes_;  // of the models, in their frames [m]
  std::string training_, scenes_;           // parts of dataset.yaml
  std::string trajectory_;                  // lines of camera.txt
  std::size_t least_points_;
  std::size_t count_ = 0;  // of scenes that are listed
};

}  // namespace sks::tools
