// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/mesh_symmetry.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <tuple>
#include <vector>

#include <Eigen/Eigenvalues>

#include "simulation/pixel_random.hpp"

namespace sks {
namespace {

constexpr std::size_t sample_count = 20000;
constexpr double cell_fraction = 0.03;  // of the box's diagonal: edge of the cubes in which positions count as the same
constexpr double same_share = 0.97;     // of the samples must fall on the mesh
constexpr int same_color = 60;          // greatest difference of any channel

/// A position on the surface.
struct Sample {
  Eigen::Vector3f position;
  Rgb color;
};

std::vector<Sample> sampleSurface(const Mesh& mesh) {
  std::vector<double> sums;
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) sums.push_back(area += double(mesh.areaVector(t).norm()));
  PixelRandom random(1, 0, 0);
  const Eigen::Vector3f center = mesh.box().center();
  const float footprint = 0.01f;  // prints finer than this do not count [m]
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < sample_count; ++i) {
    const auto found = std::upper_bound(sums.begin(), sums.end(), random.uniform() * area);
    const auto triangle = std::min(std::size_t(found - sums.begin()), sums.size() - 1);
    float u = float(random.uniform()), v = float(random.uniform());
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    samples.push_back({mesh.point(triangle, u, v) - center, mesh.color(triangle, u, v, footprint)});
  }
  return samples;
}

/// Says whether the surface passes near a position, in a similar colour.
class SurfaceCells {
public:
  SurfaceCells(const std::vector<Sample>& samples, float edge) : edge_(edge) {
    for (const Sample& sample : samples) cells_[cellOf(sample.position)].push_back(sample.color);
  }

  bool contains(const Sample& sample) const {
    const auto [x, y, z] = cellOf(sample.position);
    for (int k = 0; k < 27; ++k) {
      const auto cell = cells_.find({x + k % 3 - 1, y + k / 3 % 3 - 1, z + k / 9 - 1});
      if (cell == cells_.end()) continue;
      const auto similar = [&](const Rgb& c) {
        return std::abs(c.r - sample.color.r) < same_color && std::abs(c.g - sample.color.g) < same_color &&
               std::abs(c.b - sample.color.b) < same_color;
      };
      if (std::any_of(cell->second.begin(), cell->second.end(), similar)) return true;
    }
    return false;
  }

private:
  using Cell = std::tuple<int, int, int>;
  Cell cellOf(const Eigen::Vector3f& p) const {
    const auto index = [&](int axis) { return int(std::floor(p[axis] / edge_)); };
    return {index(0), index(1), index(2)};
  }

  float edge_;
  std::map<Cell, std::vector<Rgb>> cells_;
};

std::vector<Eigen::Vector3d> candidateAxes(const std::vector<Sample>& samples) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Sample& s : samples) spread += (s.position * s.position.transpose()).cast<double>();
  const Eigen::Matrix3d principal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors();
  std::vector<Eigen::Vector3d> axes{Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitX()};
  for (int i = 0; i < 3; ++i) axes.push_back(principal.col(i).normalized());
  return axes;
}

}  // namespace

std::optional<Symmetry> estimateSymmetry(const Mesh& mesh) {
  const std::vector<Sample> samples = sampleSurface(mesh);
  const float edge = float(cell_fraction) * mesh.box().diagonal().norm();
  const SurfaceCells cells(samples, edge);
  const auto falls = [&](const Eigen::Vector3d& axis, double angle) {
    const Eigen::Matrix3f turn = Eigen::AngleAxisd(angle, axis).toRotationMatrix().cast<float>();
    std::size_t same = 0;
    const std::size_t stride = 10;
    for (std::size_t i = 0; i < samples.size(); i += stride) {
      same += cells.contains({turn * samples[i].position, samples[i].color});
    }
    return double(same * stride) >= same_share * double(samples.size());
  };
  const auto axes = candidateAxes(samples);
  for (const Eigen::Vector3d& axis : axes) {
    const double angles[] = {0.4, 0.9, 1.7, 2.3, 2.9};
    if (std::all_of(std::begin(angles), std::end(angles), [&](double a) { return falls(axis, a); }))
      return Symmetry{axis, 0};
  }
  for (int order = 8; order >= 2; --order) {
    for (const Eigen::Vector3d& axis : axes) {
      bool all = true;
      for (int turn = 1; turn < order && all; ++turn) all = falls(axis, turn * 2 * EIGEN_PI / order);
      if (all) return Symmetry{axis, order};
    }
  }
  return std::nullopt;
}

}  // namespace sks
