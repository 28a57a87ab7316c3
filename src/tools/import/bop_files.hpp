// SPDX-License-Identifier: BSD-3-Clause
// The files of a data set in the format of the BOP challenge; all lengths in millimetres.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/cloud.hpp>

#include "io/symmetry.hpp"

namespace sks::tools {

struct BopInstance {
  int object = 0;                    ///< obj_id
  Eigen::Isometry3d T_camera_model;  ///< [mm]
  std::optional<double> visibility;  ///< visib_fract of scene_gt_info.json, where that is there
};

struct BopCamera {
  double fx = 0, fy = 0, cx = 0, cy = 0;  ///< [px]
  double depth_scale = 1;                 ///< millimetres of one step of the depth image
};

/// One image of a scene's folder.
struct BopImage {
  int id = 0;
  BopCamera camera;
  bool has_truth = false;  ///< else nobody says what is in it: test images of some sets
  std::vector<BopInstance> instances;
};

/// The images of a scene's folder.
struct BopScene {
  std::vector<BopImage> images;
  std::vector<std::string> warnings;  ///< poses that had to be mended, with counts
};

/// The images that scene_camera.json lists, by number, with scene_gt.json and scene_gt_info.json where they are there.
/// Rotations become the nearest ones. @throws Error(bad_file) naming file, image and key; Error(bad_data) for a pose
/// that is not rigid
BopScene readBopScene(const std::filesystem::path& folder);

/// The pictures of one image.
struct BopPictures {
  std::string depth;  ///< path; empty where it is not there
  std::string color;  ///< the same

  /// All that the scene's folder should have.
  bool complete = false;
};

/// Looks for `depth/<image>` and `rgb/<image>` with any of the extensions that BOP sets have. Sets without a folder
/// `rgb` have no colour.
BopPictures findBopPictures(const std::filesystem::path& folder, int image);

/// What models_info.json says of an object.
struct BopModelInfo {
  std::optional<double> diameter;              ///< [mm]
  std::optional<ObjectSymmetries> symmetries;  ///< all of them [mm]
  std::optional<Symmetry> symmetry;            ///< where all are about one axis
};

/// The content of models_info.json by object; empty where the file is not there.
/// @throws Error(bad_file), Error(bad_data) naming file, object and key
std::map<int, BopModelInfo> readBopModelInfo(const std::filesystem::path& models);

/// The organised cloud of an image in the camera's frame [mm], coloured where there is a colour picture; NaN where
/// there is no depth. @throws Error(bad_file) naming the picture and what is wrong with it
Cloud readBopCloud(const BopPictures& pictures, const BopCamera& camera);

/// A number as it stands in file names: 000012.
std::string bopNumber(int number);

}  // namespace sks::tools
