// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include <sks_detector/cloud.hpp>
#include <sks_detector/settings.hpp>
#include <sks_detector/stages/point_grid.hpp>

namespace sks {

/// Which way normals point.
enum class Orientation {
  sensor,  ///< towards the sensor origin: scenes and views
  outward  ///< away from the inside: full models
};

/// A prepared cloud: the one representation that every stage reads.
struct Surface : PointGrid {
  using PointGrid::PointGrid;

  bool hasColor() const { return !color.empty(); }
  Eigen::Vector3f normal(std::size_t i) const { return {nx[i], ny[i], nz[i]}; }
  Eigen::Vector3f colorAt(std::size_t i) const { return {color[i][0], color[i][1], color[i][2]}; }

  std::vector<float> nx, ny, nz;            ///< unit normals; NaN where none could be estimated
  std::vector<std::array<float, 3>> color;  ///< CIELab, scaled: L / 100, a / 120, b / 120; empty without colour
  Eigen::Vector3f sensor_origin = Eigen::Vector3f::Zero();  ///< [m]
  Orientation orientation = Orientation::sensor;            ///< of the normals, once estimated
  float step = 1;  ///< between the rows and columns of the image that prepareScene() kept
};

/// Sorts the points of a sanitized cloud and converts their colours; normals are left empty (see estimateNormals()).
/// @param cell edge of the rows of the neighbour search [m]; best at about the smallest search radius
Surface makeSurface(const Cloud& cloud, double cell, int threads = 1);

/// A sanitized cloud, thinned, sorted and with normals: the input of every later stage.
Surface prepareSurface(const Cloud& sanitized, const SurfaceSettings& settings, Orientation orientation, int threads);

/// The same of a scene. An image is thinned to `surface.spacing_at_1m` after its normals were estimated from all
/// points: every n-th row and column is kept, and most later stages take half the time.
Surface prepareScene(const Cloud& sanitized, const SurfaceSettings& settings, int threads);

/// One point per occupied cube of the given edge: the one nearest to the centroid of the cube's points. The same for
/// any number of threads.
Cloud thin(const Cloud& cloud, double edge, int threads = 1);

/// The same of points in a grid: their indices, by cube.
std::vector<std::uint32_t> thinnedIndices(const PointGrid& points, double edge);

}  // namespace sks
