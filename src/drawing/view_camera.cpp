// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/view_camera.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace sks {
namespace {

std::vector<Eigen::Vector3d> finitePoints(const Cloud& cloud) {
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3f& p : cloud.points) {
    if (p.allFinite()) points.emplace_back(p.cast<double>());
  }
  return points;
}

/// A camera at `eye` that looks along `forward`, with `up` as near to upwards as can be.
Eigen::Isometry3d lookAlong(const Eigen::Vector3d& eye, const Eigen::Vector3d& forward, const Eigen::Vector3d& up) {
  const Eigen::Vector3d z = forward.normalized();
  const Eigen::Vector3d x = z.cross(up).normalized();
  Eigen::Matrix3d axes;
  axes << x.transpose(), z.cross(x).transpose(), z.transpose();
  Eigen::Isometry3d T_camera_cloud = Eigen::Isometry3d::Identity();
  T_camera_cloud.linear() = axes;
  T_camera_cloud.translation() = -axes * eye;
  return T_camera_cloud;
}

/// Depth cameras look along +z with y downwards, graphics and models along -z with y upwards.
Eigen::Vector3d upFor(const Eigen::Vector3d& forward) {
  if (std::abs(forward.y()) > 0.9) return Eigen::Vector3d::UnitZ();
  return {0, forward.z() > 0 ? -1.0 : 1.0, 0};
}

/// Whether nearly all points lie within an angle of a direction, seen from `eye`.
bool ahead(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& eye, const Eigen::Vector3d& forward,
           double degrees) {
  const double cosine = std::cos(degrees * EIGEN_PI / 180);
  const auto inside = [&](const Eigen::Vector3d& p) { return (p - eye).dot(forward) > cosine * (p - eye).norm(); };
  return double(std::count_if(points.begin(), points.end(), inside)) > 0.97 * double(points.size());
}

Eigen::Isometry3d choosePose(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& sensor) {
  if (points.empty()) return Eigen::Isometry3d::Identity();
  if (ahead(points, sensor, Eigen::Vector3d::UnitZ(), 60)) {  // wide, as it is the usual direction
    return lookAlong(sensor, Eigen::Vector3d::UnitZ(), upFor(Eigen::Vector3d::UnitZ()));
  }
  Eigen::Vector3d low = points.front(), high = low, sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
    sum += p;
  }
  const Eigen::Vector3d center = sum / double(points.size());
  Eigen::Vector3d eye = sensor, forward = (center - sensor).normalized();
  if (!forward.allFinite() || !ahead(points, sensor, forward, 45)) {
    forward = Eigen::Vector3d(-0.5, -0.3, -1).normalized();
    eye = center - 1.5 * (high - low).norm() * forward;
  }
  return lookAlong(eye, forward, upFor(forward));
}

/// Range of the values without the outermost 0.2 % on each side.
std::pair<double, double> innerRange(std::vector<double> values) {
  const std::size_t cut = values.size() / 500;
  const auto at = [&](std::size_t i) {
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(i), values.end());
    return values[i];
  };
  const double low = at(cut);
  return {low, at(values.size() - 1 - cut)};
}

}  // namespace

ViewCamera::ViewCamera(const Cloud& cloud, PictureSize size)
    : focal_(size.width), center_(0.5 * size.width, 0.5 * size.height) {
  const std::vector<Eigen::Vector3d> points = finitePoints(cloud);
  T_camera_cloud_ = choosePose(points, cloud.sensor_origin.cast<double>());

  std::vector<double> u, v;
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d p = toCamera(point);
    if (p.z() < near_plane) continue;
    u.push_back(p.x() / p.z());
    v.push_back(p.y() / p.z());
  }
  if (u.empty()) return;
  const auto [left, right] = innerRange(std::move(u));
  const auto [top, bottom] = innerRange(std::move(v));
  constexpr double margin = 0.94, narrowest = 1e-3;
  focal_ = margin *
           std::min(size.width / std::max(right - left, narrowest), size.height / std::max(bottom - top, narrowest));
  center_ -= 0.5 * focal_ * Eigen::Vector2d(left + right, top + bottom);
}

Eigen::Vector2d ViewCamera::pixel(const Eigen::Vector3d& in_camera) const {
  return center_ + focal_ / in_camera.z() * Eigen::Vector2d(in_camera.x(), in_camera.y());
}

Eigen::Vector3d ViewCamera::ray(double column, double row) const {
  return {(column - center_.x()) / focal_, (row - center_.y()) / focal_, 1};
}

}  // namespace sks
