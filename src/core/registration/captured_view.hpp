// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/settings.hpp>
#include <sks_detector/stages/descriptors.hpp>
#include <sks_detector/stages/keypoints.hpp>
#include <sks_detector/stages/matching.hpp>
#include <sks_detector/stages/surface.hpp>

#include "core/registration/view_silhouette.hpp"
#include "core/verification/range_image.hpp"

namespace sks {

/// A view of an object alone, as it is compared with other views of it: thinned points for alignment, descriptors for
/// first poses, and what its camera saw in each direction. In the frame of its cloud [m]. Immutable once built;
/// thread-safe.
struct CapturedView {
  CapturedView() = default;
  /// @param surface with normals; the object alone
  /// @param plane that the object stood on, its normal towards the object, where it is known
  CapturedView(Surface surface, const Keypoints& keypoints, const Descriptors& descriptors, const Settings& settings,
               std::optional<Eigen::Hyperplane<double, 3>> plane = std::nullopt);

  bool hasColor() const { return !colors.empty(); }

  std::string source;  ///< name, for people
  Surface surface;     ///< all points
  PointGrid points;    ///< of these about one for each cube of `spacing`; all have normals
  float spacing = 0;
  std::vector<Eigen::Vector3f> normals, colors;  ///< of `points`, in their order; colours as in Surface or none
  std::vector<std::uint32_t> surface_point;      ///< of `points`: which they are of `surface`
  std::vector<Eigen::Vector3f> prints;           ///< of `surface`, see printsOf(); none without colour
  std::vector<Eigen::Vector3f> keypoints;        ///< of the descriptors
  std::vector<Eigen::Matrix3f> frames;
  DescriptorMatrix descriptors;
  std::shared_ptr<const Matcher> matcher;  ///< finds the nearest of them
  RangeImage image;
  ViewSilhouette silhouette;
  std::optional<Eigen::Hyperplane<double, 3>> plane;
  std::optional<Eigen::Isometry3d> T_fixed_view;     ///< see TrainingSample::T_fixed_source
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< centroid of `points`
  double radius = 0;                                 ///< root mean square distance of `points` from it
};

}  // namespace sks
