// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include <sks_detector/codebook.hpp>
#include <sks_detector/stages/surface.hpp>

namespace sks {

/// Rotation and translation, as kernels take them.
using RigidRows = Eigen::Matrix<float, 3, 4, Eigen::RowMajor>;

/// Some points of a stored surface and their normals side by side, padded with points that face nowhere.
struct SurfaceSample {
  /// Takes every `stride`-th point of a view's surface.
  void take(const TrainingView& view, std::size_t stride) { take(view.surface_points, view.surface_normals, stride); }

  void take(const std::vector<Eigen::Vector3f>& points, const std::vector<Eigen::Vector3f>& normals,
            std::size_t stride) {
    clear();
    for (std::size_t i = 0; i < points.size(); i += stride) add(points[i], normals[i]);
    finish();
  }

  /// Takes the points of these numbers.
  void take(const std::vector<Eigen::Vector3f>& points, const std::vector<Eigen::Vector3f>& normals,
            const std::vector<std::size_t>& numbers) {
    clear();
    for (const std::size_t i : numbers) add(points[i], normals[i]);
    finish();
  }

  Eigen::Vector3f point(std::size_t i) const { return {x[i], y[i], z[i]}; }
  Eigen::Vector3f normal(std::size_t i) const { return {nx[i], ny[i], nz[i]}; }

  std::vector<float> x, y, z, nx, ny, nz;
  std::size_t size = 0;
  Eigen::Vector3f centroid = Eigen::Vector3f::Zero();  ///< [m]

private:
  void clear() {
    for (auto* axis : {&x, &y, &z, &nx, &ny, &nz}) axis->clear();
  }

  void finish() {
    size = x.size();
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (std::size_t i = 0; i < size; ++i) sum += point(i);
    centroid = sum / float(std::max<std::size_t>(1, size));
    for (std::size_t i = 0; i < PointGrid::simd_padding; ++i) add(centroid, Eigen::Vector3f::Zero());
  }

  void add(const Eigen::Vector3f& p, const Eigen::Vector3f& n) {
    x.push_back(p.x());
    y.push_back(p.y());
    z.push_back(p.z());
    nx.push_back(n.x());
    ny.push_back(n.y());
    nz.push_back(n.z());
  }
};

}  // namespace sks
