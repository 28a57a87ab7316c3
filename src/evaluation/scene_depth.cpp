// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/scene_depth.hpp"

#include <cmath>

#include "core/surface/pinhole_fit.hpp"

namespace sks {

double SceneCamera::rayLength(int column, int row) const {
  return std::sqrt(1 + std::pow((column - cx) / fx, 2) + std::pow((row - cy) / fy, 2));
}

std::optional<SceneDepth> sceneDepth(const Cloud& cloud, int threads) {
  if (!cloud.organized()) return std::nullopt;
  SceneDepth scene;
  scene.depth.assign(cloud.size(), 0.0f);
  Cloud measured;
  measured.columns = cloud.width;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f& p = cloud.points[i];
    if (!p.allFinite() || p.isZero()) continue;
    measured.points.push_back(p);
    measured.pixels.push_back(std::uint32_t(i));
    scene.depth[i] = p.z();
  }
  const std::optional<Pinhole> pinhole = fitPinhole(measured, threads);
  if (!pinhole || pinhole->focal_x <= 0 || pinhole->focal_y <= 0) return std::nullopt;
  scene.camera = {int(cloud.width), int(cloud.height), pinhole->focal_x,
                  pinhole->focal_y, pinhole->center_x, pinhole->center_y};
  return scene;
}

}  // namespace sks
