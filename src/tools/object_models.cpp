// SPDX-License-Identifier: BSD-3-Clause
#include "tools/object_models.hpp"

#include <sks_detector/cloud_io.hpp>
#include <sks_detector/error.hpp>

#include "simulation/mesh_sampler.hpp"

namespace sks::tools {
namespace {

/// The vertices that triangles use.
void takeMesh(const Mesh& mesh, ObjectModel& model) {
  std::vector<int> numbers(mesh.vertices.size(), -1);
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    Eigen::Vector3i taken;
    for (int k = 0; k < 3; ++k) {
      int& number = numbers[std::size_t(triangle[k])];
      if (number < 0) {
        number = int(model.points.size());
        model.points.push_back(mesh.vertices[std::size_t(triangle[k])].cast<double>());
      }
      taken[k] = number;
    }
    model.triangles.push_back(taken);
  }
}

ObjectModel loadModel(const TrainingEntry& entry, double scale) {
  ObjectModel model;
  if (entry.mesh) {
    takeMesh(entryMesh(entry, scale).mesh, model);
  } else {
    for (const Eigen::Vector3f& point : readCloud(entry.path, scale).points) {
      if (point.allFinite()) model.points.push_back(point.cast<double>());
    }
  }
  model.diameter = entry.diameter ? *entry.diameter : diameterOf(model.points);
  if (model.diameter <= 0) throw Error(ErrorCode::bad_data, "'" + entry.path + "' has no extent");
  if (entry.symmetries) {
    model.symmetries = symmetryMotions(*entry.symmetries);
  } else if (entry.symmetry) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& point : model.points) box.extend(point);
    model.symmetries = symmetryMotions(listedSymmetries(*entry.symmetry, box.center()));
  }
  return model;
}

}  // namespace

ModelLoader objectModels(const DataSet& data_set) {
  return [&data_set](const TrainingEntry& entry) { return loadModel(entry, entry.scale.value_or(data_set.scale)); };
}

}  // namespace sks::tools
