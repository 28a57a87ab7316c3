// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/cloud.hpp>
#include <sks_detector/codebook.hpp>
#include <sks_detector/progress.hpp>
#include <sks_detector/settings.hpp>
#include <sks_detector/stages/stages.hpp>

namespace sks {

/// One training cloud, loaded when its turn comes so that few are in memory at a time.
struct TrainingSample {
  std::string object;  ///< name
  std::string source;  ///< for people and for pose frames: the cloud's path in the data set file
  ViewKind kind = ViewKind::view;
  std::function<Cloud()> load;             ///< of rendered ones called by several threads at once
  std::string frame;                       ///< of views that are registered to each other: name of their common frame
  std::optional<Eigen::AlignedBox3f> box;  ///< of the whole object [m]; else the box of the cloud is taken
  bool rendered = false;                   ///< from a mesh, whose colours are not those of the camera that detects
  /// Of a view that was registered: pose of the cloud's frame in the model frame. The box is in the model frame.
  std::optional<Eigen::Isometry3d> T_model_source = std::nullopt;
  /// Of a captured view: the plane that the object stood on, its normal towards the object; frame of the cloud [m].
  std::optional<Eigen::Hyperplane<double, 3>> plane = std::nullopt;
  /// Of a captured view: pose of the cloud's frame in a frame in which the object stood still, where the camera was
  /// moved around it and it is known how [m]. Its turn about the plane's normal should be right to a degree or two.
  std::optional<Eigen::Isometry3d> T_fixed_source = std::nullopt;
};

/// Section 3.1: normals, grid keypoints without selection, descriptors, one codeword each. Deterministic, for any
/// number of threads; may be called from several threads at once.
/// @param name of the codebook
/// @param progress called before each sample, by the calling thread, and once at the end
/// @param stages in place of this package's own; the verifier is not used
/// @return what Detector and writeCodebook() take
/// @throws Error(bad_usage) for no samples, invalid settings or a descriptor stage whose name cannot be stored;
///         Error(bad_data) naming the sample whose cloud is unusable, less than 1 mm large or yields no codeword;
///         Error(cancelled)
Codebook train(const std::vector<TrainingSample>& samples, const Settings& settings, const std::string& name,
               const Progress& progress = {}, const Stages& stages = {});

/// What is odd about a trained codebook but can be used: objects that are smaller, flatter or thinner than what its
/// settings can find, each with the settings that would. Empty if there is nothing.
std::vector<std::string> trainingWarnings(const Codebook& codebook);

}  // namespace sks
