// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <sks_detector/cloud.hpp>
#include <sks_detector/simulation/camera_model.hpp>

#include "simulation/pixel_random.hpp"

namespace sks {

/// What a ray of the depth camera meets.
struct SeenSurface {
  float depth;   ///< [m]
  float cosine;  ///< of the angle between ray and normal
  double lost;   ///< share of the surface that gives no depth
  Rgb color;
};

/// Whether two depths of neighbouring pixels belong to different surfaces.
bool isEdge(float depth, float other);

/// The errors in one depth picture: random fields that all of its pixels share, and what is drawn for each pixel.
class DepthErrors {
public:
  DepthErrors(const CameraModel& camera, std::uint64_t frame, int threads);

  /// Errors of neighbouring pixels are alike.
  bool smooth() const { return camera_.noise.disparity_sigma > 0; }
  /// How far away from a pixel its depth is measured [px]; 0 without lateral noise. Always takes two random numbers.
  Eigen::Vector2d lateral(std::size_t pixel, PixelRandom& random) const;
  /// The depth that the sensor makes of a true one [m]; NaN where it loses it. Nothing may be drawn for the
  /// pixel afterwards.
  double measured(const SeenSurface& surface, std::size_t pixel, PixelRandom& random) const;

  bool needsEdges() const { return camera_.noise.edge_loss > 0; }
  /// Takes points away that lie beside edges. @param depth true depth of each pixel [m]
  void loseEdges(const std::vector<float>& depth, std::vector<Eigen::Vector3f>& points, int threads) const;

private:
  CameraModel camera_;
  std::vector<float> disparity_, aside_, down_, patches_;  // fields; empty where not needed
};

}  // namespace sks
