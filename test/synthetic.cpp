// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace sks::test {
namespace {

/// Uniform in -1 to 1; the distributions of the standard library differ between platforms.
float uniform(std::mt19937& random) {
  return float(random() / 2147483648.0 - 1.0);
}

std::vector<Eigen::Vector3f> spreadDirections(int count) {
  std::vector<Eigen::Vector3f> directions;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2.0 * i + 1) / count, r = std::sqrt(1 - z * z), angle = M_PI * (3 - std::sqrt(5.0)) * i;
    directions.emplace_back(float(r * std::cos(angle)), float(r * std::sin(angle)), float(z));
  }
  return directions;
}

Rgb colorAt(const Eigen::Vector3f& p) {
  const auto channel = [](float value) { return std::uint8_t(std::clamp(value, 0.0f, 255.0f)); };
  return {channel(128 + 1100 * p.x()), channel(128 - 1300 * p.y()), channel(120 + 900 * p.z() + 600 * p.x())};
}

}  // namespace

bool Solid::contains(const Eigen::Vector3f& p) const {
  const Eigen::Array3f q = (p - center).array() / half.array();
  return shape == Shape::box ? (q.abs() < 1).all() : q.matrix().squaredNorm() < 1;
}

float Solid::hit(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const {
  const Eigen::Array3f o = (origin - center).array() / half.array(), d = direction.array() / half.array();
  if (shape == Shape::ellipsoid) {
    const float a = d.matrix().squaredNorm(), b = (o * d).sum(), c = o.matrix().squaredNorm() - 1;
    const float root = b * b - a * c;
    return root < 0 ? -1 : (-b - std::sqrt(root)) / a;
  }
  float enter = 0, leave = std::numeric_limits<float>::max();
  for (int axis = 0; axis < 3; ++axis) {
    if (d[axis] == 0) {
      if (std::abs(o[axis]) > 1) return -1;
      continue;
    }
    const float s = (-1 - o[axis]) / d[axis], t = (1 - o[axis]) / d[axis];
    enter = std::max(enter, std::min(s, t));
    leave = std::min(leave, std::max(s, t));
  }
  return enter < leave && enter > 0 ? enter : -1;
}

std::vector<Eigen::Vector3f> Solid::sample(float spacing) const {
  std::vector<Eigen::Vector3f> points;
  if (shape == Shape::ellipsoid) {
    const float mean = std::cbrt(half.prod());
    for (const auto& u : spreadDirections(int(4 * M_PI * mean * mean / (spacing * spacing)))) {
      points.push_back(center + half.cwiseProduct(u));
    }
    return points;
  }
  std::mt19937 random(7);
  for (int axis = 0; axis < 3; ++axis) {
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    const int columns = std::max(1, int(2 * half[a] / spacing)), rows = std::max(1, int(2 * half[b] / spacing));
    for (int i = 0; i < 2 * columns * rows; ++i) {
      Eigen::Vector3f u;
      u[axis] = i % 2 ? 1 : -1;
      u[a] = 2 * (float(i / 2 % columns) + 0.5f + 0.2f * uniform(random)) / float(columns) - 1;
      u[b] = 2 * (float(i / 2 / columns) + 0.5f + 0.2f * uniform(random)) / float(rows) - 1;
      points.push_back(center + half.cwiseProduct(u));
    }
  }
  return points;
}

bool contains(const Shape& shape, const Eigen::Vector3f& p) {
  return std::any_of(shape.begin(), shape.end(), [&](const Solid& solid) { return solid.contains(p); });
}

Shape asymmetricShape() {
  using S = Solid::Shape;
  return {{S::box, {0.01f, 0, 0}, {0.07f, 0.045f, 0.03f}},
          {S::ellipsoid, {0.06f, 0.03f, 0.035f}, {0.035f, 0.025f, 0.03f}},
          {S::box, {-0.04f, -0.015f, 0.05f}, {0.015f, 0.02f, 0.035f}},
          {S::ellipsoid, {0.02f, -0.05f, 0}, {0.02f, 0.025f, 0.015f}},
          {S::box, {0.04f, 0, -0.04f}, {0.02f, 0.03f, 0.02f}},
          {S::ellipsoid, {-0.065f, 0.02f, -0.01f}, {0.02f, 0.02f, 0.03f}}};
}

Shape roundedShape() {
  using S = Solid::Shape;
  return {{S::ellipsoid, {0, 0, 0}, {0.06f, 0.06f, 0.05f}},
          {S::ellipsoid, {0.06f, 0, 0.02f}, {0.03f, 0.015f, 0.03f}},
          {S::ellipsoid, {0, 0.05f, -0.03f}, {0.02f, 0.04f, 0.02f}}};
}

Shape cupShape() {
  using S = Solid::Shape;
  return {{S::box, {0, 0, -0.042f}, {0.05f, 0.05f, 0.008f}},
          {S::box, {-0.042f, 0, 0}, {0.008f, 0.05f, 0.05f}},
          {S::box, {0.042f, 0, 0}, {0.008f, 0.05f, 0.05f}},
          {S::box, {0, -0.042f, 0}, {0.05f, 0.008f, 0.05f}},
          {S::box, {0, 0.042f, 0}, {0.05f, 0.008f, 0.05f}}};
}

Shape angleShape() {
  using S = Solid::Shape;
  return {{S::box, {0, 0, 0}, {0.1f, 0.03f, 0.02f}}, {S::box, {-0.08f, 0, 0.06f}, {0.02f, 0.03f, 0.05f}}};
}

Cloud model(const Shape& shape, float spacing, bool color) {
  Cloud cloud;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    for (const auto& p : shape[i].sample(spacing)) {
      bool inner = false;  // in another solid, or on a face that two share and the first one has
      for (std::size_t k = 0; k < shape.size(); ++k) {
        Solid grown = shape[k];
        grown.half.array() += (k < i ? 1e-5f : -1e-5f);
        inner = inner || (k != i && grown.contains(p));
      }
      if (!inner) cloud.points.push_back(p);
    }
  }
  if (color) {
    for (const auto& p : cloud.points) cloud.colors.push_back(colorAt(p));
  }
  cloud.width = std::uint32_t(cloud.size());
  return cloud;
}

Cloud view(const std::vector<Placed>& scene, float pixel, std::uint32_t width, std::uint32_t height, bool color) {
  Cloud cloud;
  cloud.width = width;
  cloud.height = height;
  for (std::uint32_t i = 0; i < width * height; ++i) {
    const Eigen::Vector3f ray((float(i % width) - 0.5f * float(width)) * pixel,
                              (float(i / width) - 0.5f * float(height)) * pixel, 1);
    float depth = std::numeric_limits<float>::infinity();
    Rgb seen;
    for (const Placed& placed : scene) {
      const Eigen::Isometry3f inverse = placed.T_camera_shape.inverse();
      const Eigen::Vector3f origin = inverse.translation(), direction = inverse.linear() * ray;
      for (const Solid& solid : placed.shape) {
        const float distance = solid.hit(origin, direction);
        if (distance <= 0 || distance >= depth) continue;
        depth = distance;
        seen = colorAt(origin + distance * direction);
      }
    }
    const bool found = std::isfinite(depth);
    cloud.points.push_back(found ? Eigen::Vector3f(depth * ray)
                                 : Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
    if (color) cloud.colors.push_back(seen);
  }
  return cloud;
}

Cloud sphere(float radius, float spacing, const Eigen::Vector3f& center) {
  return makeCloud(Solid{Solid::Shape::ellipsoid, center, Eigen::Vector3f::Constant(radius)}.sample(spacing));
}

Cloud torus(float ring_radius, float tube_radius, float spacing) {
  std::vector<Eigen::Vector3f> points;
  const int around = int(2 * M_PI * tube_radius / spacing);
  for (int k = 0; k < around; ++k) {
    const double tube = 2 * M_PI * k / around;
    const double r = ring_radius + tube_radius * std::cos(tube);
    const int count = int(2 * M_PI * r / spacing);
    for (int i = 0; i < count; ++i) {
      const double ring = 2 * M_PI * (i + 0.37 * k) / count;
      points.emplace_back(float(r * std::cos(ring)), float(r * std::sin(ring)), float(tube_radius * std::sin(tube)));
    }
  }
  return makeCloud(std::move(points));
}

Cloud plane(float edge, float spacing) {
  std::vector<Eigen::Vector3f> points;
  const int count = int(edge / spacing);
  for (int i = 0; i < count * count; ++i) {
    points.emplace_back((float(i % count) + 0.5f) * spacing - edge / 2, (float(i / count) + 0.5f) * spacing - edge / 2,
                        1.0f);
  }
  return makeCloud(std::move(points));
}

Cloud randomCloud(std::size_t size, float extent, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<Eigen::Vector3f> points(size);
  for (auto& p : points) {
    for (int axis = 0; axis < 3; ++axis) p[axis] = extent * uniform(random);
  }
  return makeCloud(std::move(points));
}

Cloud makeCloud(std::vector<Eigen::Vector3f> points) {
  Cloud cloud;
  cloud.points = std::move(points);
  cloud.width = std::uint32_t(cloud.points.size());
  return cloud;
}

Cloud transformed(const Cloud& cloud, const Eigen::Isometry3f& T) {
  Cloud moved = cloud;
  for (auto& p : moved.points) p = T * p;
  moved.sensor_origin = T * cloud.sensor_origin;
  return moved;
}

Cloud merged(const std::vector<Cloud>& clouds) {
  Cloud all;
  all.sensor_origin = clouds.front().sensor_origin;
  for (const Cloud& cloud : clouds) {
    all.points.insert(all.points.end(), cloud.points.begin(), cloud.points.end());
    all.colors.insert(all.colors.end(), cloud.colors.begin(), cloud.colors.end());
  }
  all.width = std::uint32_t(all.size());
  return all;
}

Cloud shuffled(const Cloud& cloud, std::uint32_t seed) {
  std::mt19937 random(seed);
  Cloud mixed = cloud;
  for (std::size_t i = mixed.size(); i > 1; --i) {
    const std::size_t k = random() % i;
    std::swap(mixed.points[i - 1], mixed.points[k]);
    if (mixed.hasColor()) std::swap(mixed.colors[i - 1], mixed.colors[k]);
  }
  mixed.width = std::uint32_t(mixed.size());
  mixed.height = 1;
  return mixed;
}

Eigen::Isometry3f poseOf(float degrees, const Eigen::Vector3f& axis, const Eigen::Vector3f& translation) {
  Eigen::Isometry3f pose = Eigen::Isometry3f::Identity();
  pose.linear() = Eigen::AngleAxisf(degrees * float(M_PI) / 180, axis.normalized()).toRotationMatrix();
  pose.translation() = translation;
  return pose;
}

double angleDegrees(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return Eigen::AngleAxisd(a.transpose() * b).angle() * 180 / M_PI;
}

}  // namespace sks::test
