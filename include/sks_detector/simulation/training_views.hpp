// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <sks_detector/simulation/camera_model.hpp>
#include <sks_detector/simulation/mesh.hpp>
#include <sks_detector/trainer.hpp>

namespace sks {

/// How a mesh is looked at for training.
struct MeshTraining {
  int views = 42;         ///< directions around the mesh
  double distance = 0.8;  ///< of the camera from the middle of the mesh, more for meshes that would not fit [m]
  bool noise = false;     ///< with the errors of the camera
  CameraModel camera;
  int threads = 2;
};

/// Views of a mesh from all sides as samples for train(), each rendered when its turn comes. They are registered in the
/// frame of the mesh, named `source`, and vote for the centre of its box; the views are called `source#0`, `source#1`
/// ...
/// @throws Error(bad_usage) for impossible settings; loading a sample Error(bad_data) if nothing can be seen
std::vector<TrainingSample> meshSamples(const std::string& object, const std::string& source,
                                        const std::shared_ptr<const Mesh>& mesh, const MeshTraining& training);

/// The same without keeping the mesh: it is loaded again for the first view that is rendered, and let go with the last.
/// @param load gives the mesh; the samples may call it from any thread, one at a time, and pass on what it throws
std::vector<TrainingSample> meshSamples(const std::string& object, const std::string& source, const Mesh& mesh,
                                        const std::function<std::shared_ptr<const Mesh>()>& load,
                                        const MeshTraining& training);

/// A camera at `eye` that looks at `target`; the image's rows run across the direction of `up`.
Eigen::Isometry3d lookAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target, const Eigen::Vector3d& up);

}  // namespace sks
