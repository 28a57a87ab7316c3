// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/codebook.hpp>
#include <sks_detector/settings.hpp>
#include <sks_detector/stages/large_planes.hpp>
#include <sks_detector/stages/surface.hpp>

#include "core/verification/range_image.hpp"
#include "core/verification/surface_weights.hpp"

namespace sks {

constexpr float grazing = 0.17f;    ///< cosine; surfaces turned away by more than 80 degrees are hardly measured
constexpr double unmeasured = 0.5;  ///< weight of what should be seen where the sensor measured nothing

/// A scene as poses are compared with it. Refers to the surface.
struct SceneView {
  SceneView(const Surface& scene, const Settings& settings, int threads = 1);
  /// @param large_planes of findLargePlanes()
  SceneView(const Surface& scene, std::vector<LargePlane> large_planes, const Settings& settings, int threads = 1);

  /// Whether the colours of a view are compared with those of the scene.
  bool comparesColor(const TrainingView& view) const { return color_tolerance > 0 && !view.surface_colors.empty(); }

  const Surface& surface;
  RangeImage range_image;
  std::vector<LargePlane> planes;
  float color_tolerance;  // units of CIELab; 0: colours are not compared
  /// By which light and white balance have moved the scene's colours from those of the models; as in Surface.
  Eigen::Vector3f color_shift = Eigen::Vector3f::Zero();

  std::vector<char> rises;  ///< of findStandingThings()

  /// Whether a scene point lies on a plane that is larger than an object: it is no part of it.
  bool onLargerPlane(std::uint32_t point, float object_size) const {
    return !rises[point] && planeExtentAt(planes, surface.point(point), surface.normal(point)) > object_size;
  }

  /// Of a scene point, as under the light of the models.
  Eigen::Vector3f colorAt(std::uint32_t point) const { return surface.colorAt(point) - color_shift; }
};

/// What the scene says to a view's stored surface in some pose. Areas are in m^2; weighted ones are multiplied with the
/// weights of the surface. What is occluded, or lies on a plane larger than the object, speaks neither way.
struct PoseEvidence {
  double facing = 0;                      ///< area that faces the sensor
  double supported = 0;                   ///< of that, confirmed by scene points with matching normals and colours
  double occluded = 0;                    ///< of the facing area, behind what the sensor saw
  double weighted_visible = 0;            ///< weighted area that should be seen; half where nothing was measured
  double weighted_supported = 0;          ///< of that, confirmed
  std::vector<std::uint32_t> confirming;  ///< the scene points that confirm it
};

/// Which scene points may confirm a point of a stored surface.
enum class CorrespondenceSearch {
  along_ray,  ///< the one that the sensor saw in its direction
  nearby      ///< all around it
};

/// @param most_points of the stored surface that are examined, spread evenly
PoseEvidence examinePose(const TrainingView& view, const SurfaceWeights& surface_weights, const SceneView& scene,
                         const Settings& settings, const Eigen::Isometry3d& T_scene_model,
                         std::size_t most_points = 1500, CorrespondenceSearch search = CorrespondenceSearch::nearby);

}  // namespace sks
