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
  std::vector<BopInstance> instances;
};

/// The images that scene_camera.json lists, by number, with scene_gt.json and scene_gt_info.json.
/// @throws Error(bad_file) naming file, image and key
std::vector<BopImage> readBopScene(const std::filesystem::path& folder);

/// Symmetries of models_info.json by object; those about one axis alone. Empty where the file is not there.
std::map<int, Symmetry> readBopSymmetries(const std::filesystem::path& models);

/// The organised, coloured cloud of an image in the camera's frame [mm]; NaN where there is no depth.
/// @throws Error(bad_file) naming the image and what is wrong with it
Cloud readBopCloud(const std::filesystem::path& folder, const BopImage& image);

/// A number as it stands in file names: 000012.
std::string bopNumber(int number);

}  // namespace sks::tools
