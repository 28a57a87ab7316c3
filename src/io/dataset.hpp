// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/codebook.hpp>
#include <sks_detector/trainer.hpp>

#include "io/symmetry.hpp"

namespace sks {

/// One training cloud of a data set.
struct TrainingEntry {
  std::string object;  ///< name
  std::string source;  ///< the cloud as the file names it, normalised: what Detection::view holds
  std::string path;    ///< where the cloud is: resolved against the data set file
  ViewKind kind = ViewKind::view;
  bool mesh = false;                 ///< the file is a mesh, or `builtin:` and a name: views of it are rendered
  std::optional<Symmetry> symmetry;  ///< as declared
  std::optional<double> scale;       ///< metres per unit of this file, where it differs; 0 of a mesh: recognised

  std::optional<ObjectSymmetries> symmetries;  ///< all of them, where the file lists them [m]; for the BOP errors
  std::optional<double> diameter;              ///< greatest distance between two vertices, where the file states it [m]

  /// That the object stood on, its normal towards the object; of a captured view, in its frame [m].
  std::optional<Eigen::Hyperplane<double, 3>> plane = std::nullopt;
  /// Of a captured view: pose of its frame in one in which the object stood still, where the camera was moved [m].
  std::optional<Eigen::Isometry3d> T_fixed_cloud = std::nullopt;
};

/// One true instance of an object in a scene.
struct GroundTruth {
  std::string object;                                  ///< name
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< box centre of the reference, mapped into the scene [m]
  std::string reference;  ///< the training cloud that the pose maps, named like TrainingEntry::source; may be empty
  std::optional<Eigen::Isometry3d> T_scene_reference;  ///< 6-D pose of the reference's frame [m]
  std::optional<Symmetry> symmetry;                    ///< of the reference, where its training entry declares one
  std::optional<double> visibility;                    ///< fraction of the surface that is not occluded, in [0, 1]
  std::optional<std::size_t> points;                   ///< of the scene's cloud that lie on it

  /// Where the codebook has the reference as a view that was registered (registeredTruth()): name and pose of its
  /// object's model frame.
  std::string model_frame = {};
  std::optional<Eigen::Isometry3d> T_scene_model = std::nullopt;
};

/// One scene with all the instances that are in it.
struct Scene {
  std::string name;  ///< unique in its data set
  std::string path;  ///< where the cloud is
  std::vector<GroundTruth> objects;
  std::vector<std::string> ignore;  ///< objects whose detections in this scene count neither way
};

/// An isolated object that is to be classified.
struct TestEntry {
  std::string object;  ///< its true name
  std::string path;    ///< where the cloud is
};

/// What a data set file describes (docs/evaluate.md); all lengths are in metres, whatever the file's units are.
struct DataSet {
  std::string file;  ///< path it was read from
  std::string name;
  double scale = 1;         ///< metres per unit of the file and its clouds
  double max_distance = 0;  ///< farthest that a true positive lies from its ground truth [m]
  std::vector<TrainingEntry> training;
  std::vector<Scene> scenes;
  std::vector<TestEntry> tests;
  std::vector<TrainingEntry> missing;  ///< training clouds that do not exist (MissingClouds::left_out)
  std::vector<std::string> warnings;   ///< what is odd but can be used, each naming file and line
};

/// What becomes of training clouds that do not exist.
enum class MissingClouds {
  refused,
  left_out  ///< with a warning that names each; a file that lists nothing at all is read too
};

/// Reads a data set file strictly: unknown and repeated keys, unknown units, poses that are not rigid,
/// scenes of the same name and clouds that do not exist are refused before any work is done.
/// @throws Error(bad_file) if the file or a cloud is missing or the file is no YAML; Error(bad_data) naming file, line,
///         key and remedy
DataSet loadDataSet(const std::string& path, MissingClouds missing = MissingClouds::refused);

/// The same for the text of a file that need not be there yet. @param path where it is to lie
DataSet parseDataSet(const std::string& text, const std::string& path);

/// Turns a mesh into training views. @param scale metres per unit of the mesh; 0: to be recognised
using MeshSampler = std::function<std::vector<TrainingSample>(const TrainingEntry& entry, double scale)>;

/// The training clouds for train(), each read when its turn comes.
/// @throws Error(bad_usage) for meshes without a sampler
std::vector<TrainingSample> trainingSamples(const DataSet& data_set, const MeshSampler& sampler = {});

/// Objects of the ground truth that are not among the trained ones, in order of their first scene: they count as ground
/// truth and can only be missed.
std::vector<std::string> untrainedObjects(const DataSet& data_set, const std::vector<std::string>& trained);

}  // namespace sks
