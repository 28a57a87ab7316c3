// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/resting_poses.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/surface/even_directions.hpp"
#include "core/verification/farthest_point.hpp"

namespace sks {
namespace {

constexpr int falls = 400;  // from rotations spread over the sphere
constexpr int steps_of_fall = 80;
constexpr float first_step = 0.1f, last_step = 0.005f;  // [rad]
constexpr int fewest_falls = 2;                         // into a pose: else it is a dent of the samples
constexpr float together = 0.94f;                       // cosine of 20 degrees: what is nearer is one pose
constexpr std::size_t most_poses = 12;
constexpr int most_alike = 6;               // of the same height, as a can has when it rolls
constexpr float alike = 0.03f;              // of the height
constexpr float touching = 0.005f;          // [m] points so near to the plane touch it
constexpr float touching_agreement = 0.9f;  // cosine between their normals and the plane's
constexpr float top_agreement = 0.8f;       // ... and those of what faces up
constexpr float flat = 0.01f;               // [m] of a plane face's height
constexpr float least_of_face = 0.5f;       // of the base's rectangle is the face
constexpr float stick_slenderness = 5;      // length over width and height

using Rows = Eigen::Matrix<float, Eigen::Dynamic, 3>;  // a point each, axis by axis

Rows rowsOf(const std::vector<Eigen::Vector3f>& points) {
  return Eigen::Map<const Eigen::Matrix3Xf>(points.data()->data(), 3, Eigen::Index(points.size())).transpose();
}

/// How far points lie in a direction. @return a buffer of this thread
const Eigen::VectorXf& heightsOf(const Rows& points, const Eigen::Vector3f& direction) {
  thread_local Eigen::VectorXf heights;
  heights = points.col(0) * direction.x() + points.col(1) * direction.y() + points.col(2) * direction.z();
  return heights;
}

/// The points that can touch a plane, or nearly all of them.
std::vector<Eigen::Vector3f> outermost(const FarthestPoint& points) {
  std::vector<Eigen::Vector3f> all;
  for (const Eigen::Vector3d& spread : evenDirections(2 * falls)) {
    const Eigen::Vector3f p = points.along(spread.cast<float>());
    if (std::find(all.begin(), all.end(), p) == all.end()) all.push_back(p);
  }
  return all;
}

/// Tips over the point that touches the plane, towards the centre, in ever smaller steps.
Eigen::Vector3f fallen(Eigen::Vector3f down, const FarthestPoint& outer, const Eigen::Vector3f& center) {
  const float shrink = std::pow(last_step / first_step, 1.0f / float(steps_of_fall));
  float step = first_step;
  for (int i = 0; i < steps_of_fall; ++i, step *= shrink) {
    const Eigen::Vector3f lever = outer.along(down) - center, across = lever - lever.dot(down) * down;
    if (across.norm() > 0) down = (down - step * across.normalized()).normalized();
  }
  return down;
}

/// Few are: those of a block are looked at only if its highest is one of them, which SIMD lanes tell.
template <typename Function>
void forEachAbove(const Eigen::VectorXf& heights, float limit, Function&& f) {
  constexpr Eigen::Index block = 32;
  for (Eigen::Index begin = 0; begin < heights.size(); begin += block) {
    const Eigen::Index size = std::min(block, heights.size() - begin);
    if (!(heights.segment(begin, size).maxCoeff() > limit)) continue;
    for (Eigen::Index i = begin; i < begin + size; ++i) {
      if (heights[i] > limit) f(i);
    }
  }
}

/// The direction in which the touching parts of the surface face.
Eigen::Vector3f settled(const Rows& points, const Rows& normals, const Eigen::Vector3f& down) {
  const Eigen::VectorXf& heights = heightsOf(points, down);
  const float floor = heights.maxCoeff();
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  forEachAbove(heights, floor - touching, [&](Eigen::Index i) {
    if (normals.row(i).dot(down) > touching_agreement) sum += normals.row(i);
  });
  return sum.norm() > 0 ? Eigen::Vector3f(sum.normalized()) : down;
}

/// Whether the centre lies above the convex hull of what touches the plane: seen from below it, touching points lie in
/// all directions.
bool isSupported(const Rows& points, const Eigen::Vector3f& down, const Eigen::Vector3f& center) {
  const Eigen::VectorXf& heights = heightsOf(points, down);
  const float floor = heights.maxCoeff();
  const Eigen::Vector3f u = down.unitOrthogonal(), v = down.cross(u);
  std::vector<float> angles;
  forEachAbove(heights, floor - touching, [&](Eigen::Index i) {
    const Eigen::Vector3f p = points.row(i).transpose() - center;
    angles.push_back(std::atan2(v.dot(p), u.dot(p)));
  });
  std::sort(angles.begin(), angles.end());
  float widest_gap = angles.front() + float(2 * EIGEN_PI) - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i) widest_gap = std::max(widest_gap, angles[i] - angles[i - 1]);
  return widest_gap < float(EIGEN_PI);
}

/// What faces up.
void describeTop(const ModelSurface& model, RestingPose& pose) {
  std::size_t facing = 0, level = 0;
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    if (pose.down.dot(model.normals[i]) > -top_agreement) continue;
    pose.top += model.points[i];
    ++facing;
    if (pose.down.dot(model.points[i]) < pose.floor - pose.height + flat) ++level;
  }
  if (facing > 0) pose.top /= float(facing);
  const float area = float(level) * model.resolution * model.resolution;
  pose.flat_top = area > least_of_face * pose.base.length * pose.base.width;
}

}  // namespace

bool RestingPose::isStick() const {
  return base.length > stick_slenderness * std::max(base.width, height);
}

Eigen::Matrix3f RestingPose::rotation(const Eigen::Vector3f& up, const Eigen::Vector3f& axis, float angle) const {
  Eigen::Matrix3f from, to;  // columns: down, long axis, and across
  from << down, base.long_axis, down.cross(base.long_axis);
  const Eigen::Vector3f to_axis = std::cos(angle) * axis - std::sin(angle) * up.cross(axis);
  to << -up, to_axis, -up.cross(to_axis);
  return to * from.transpose();
}

BaseExtent baseExtent(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f& up) {
  const Eigen::Vector3f u = up.unitOrthogonal(), v = up.cross(u);
  Eigen::Vector2f mean = Eigen::Vector2f::Zero();
  for (const Eigen::Vector3f& p : points) mean += Eigen::Vector2f(u.dot(p), v.dot(p)) / float(points.size());
  Eigen::Matrix2f spread = Eigen::Matrix2f::Zero();
  for (const Eigen::Vector3f& p : points) {
    const Eigen::Vector2f q = Eigen::Vector2f(u.dot(p), v.dot(p)) - mean;
    spread += q * q.transpose();
  }
  const float angle = 0.5f * std::atan2(2 * spread(0, 1), spread(0, 0) - spread(1, 1));
  BaseExtent base;
  base.long_axis = std::cos(angle) * u + std::sin(angle) * v;
  const auto extentAlong = [&](const Eigen::Vector3f& axis) {
    float least = axis.dot(points[0]), most = least;
    for (const Eigen::Vector3f& p : points) least = std::min(least, axis.dot(p)), most = std::max(most, axis.dot(p));
    return most - least;
  };
  base.length = extentAlong(base.long_axis), base.width = extentAlong(up.cross(base.long_axis));
  return base;
}

std::vector<RestingPose> restingPoses(const ModelSurface& model) {
  if (model.points.empty()) return {};
  const Rows points = rowsOf(model.points), normals = rowsOf(model.normals);
  const Eigen::Vector3f center = points.colwise().mean();
  const FarthestPoint all(model.points), outer(outermost(all));
  std::vector<std::pair<int, Eigen::Vector3f>> ends;  // how many falls end there, and the first of them
  for (const Eigen::Vector3d& spread : evenDirections(falls)) {
    const Eigen::Vector3f direction = spread.cast<float>();
    const Eigen::Vector3f down = settled(points, normals, fallen(direction, outer, center));
    const auto known =
        std::find_if(ends.begin(), ends.end(), [&](const auto& end) { return end.second.dot(down) > together; });
    if (known == ends.end()) {
      ends.push_back({1, down});
    } else {
      ++known->first;
    }
  }
  std::stable_sort(ends.begin(), ends.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<RestingPose> poses;
  for (const auto& [count, down] : ends) {
    if (poses.size() >= most_poses || count < fewest_falls) break;
    if (!isSupported(points, down, center)) continue;  // still on its way, along the edge of a box
    const float floor = down.dot(all.along(down)), top = down.dot(all.along(-down));
    const float height = floor - top;
    const auto isAlike = [&](const RestingPose& pose) { return std::abs(pose.height - height) < alike * height; };
    if (std::count_if(poses.begin(), poses.end(), isAlike) >= most_alike) continue;
    RestingPose pose;
    pose.down = down, pose.height = height, pose.floor = floor;
    pose.base = baseExtent(model.points, down);
    describeTop(model, pose);
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace sks
