// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "simulation/builtin_shapes.hpp"
#include "simulation/shapes.hpp"

namespace sks {
namespace {

constexpr float step = 0.003f;  // between vertices, which carry the colours [m]
constexpr int segments = 96;

/// Angle about the z axis, 0 at +x [rad].
float angleOf(const Eigen::Vector3f& p) {
  return std::atan2(p.y(), p.x());
}

}  // namespace

Mesh makeMug() {
  const auto paint = [](const Eigen::Vector3f& p) -> Rgb {
    if (p.head<2>().norm() < 0.038f && p.z() > 0.004f) return {240, 235, 225};  // inside
    const float around = std::abs(std::abs(angleOf(p)) - float(EIGEN_PI)) * 0.042f;
    if (std::hypot(around, p.z() - 0.05f) < 0.018f) return {210, 40, 40};
    if (p.z() > 0.07f && p.z() < 0.085f) return {250, 210, 60};
    return {40, 80, 170};
  };
  Mesh mug = makeRevolution(subdivided<Eigen::Vector2f>({{0.0005f, 0},
                                                         {0.038f, 0},
                                                         {0.042f, 0.004f},
                                                         {0.042f, 0.098f},
                                                         {0.0375f, 0.098f},
                                                         {0.0375f, 0.006f},
                                                         {0.0005f, 0.006f}},
                                                        step),
                            segments, paint);
  std::vector<Eigen::Vector3f> path;
  for (int i = 0; i <= 24; ++i) {
    const float angle = float(EIGEN_PI) * (float(i) / 24 - 0.5f);
    path.emplace_back(0.040f + 0.030f * std::cos(angle), 0, 0.05f + 0.030f * std::sin(angle));
  }
  append(mug, makeTube(path, std::vector<float>(path.size(), 0.006f), 20, plain({40, 80, 170})));
  return mug;
}

Mesh makeBottle() {
  const auto paint = [](const Eigen::Vector3f& p) -> Rgb {
    if (p.z() > 0.198f) return {235, 235, 235};
    const float angle = angleOf(p);
    if (p.z() > 0.04f && p.z() < 0.12f && std::abs(angle) < 1.4f) {
      if (p.z() > 0.095f) return {200, 30, 50};
      if (std::fmod(angle + 2.0f, 0.5f) < 0.2f && p.z() > 0.06f) return {60, 40, 120};
      return {245, 220, 120};
    }
    return {40, 130, 70};
  };
  return makeRevolution(subdivided<Eigen::Vector2f>({{0.0005f, 0},
                                                     {0.030f, 0},
                                                     {0.034f, 0.006f},
                                                     {0.034f, 0.13f},
                                                     {0.026f, 0.16f},
                                                     {0.014f, 0.18f},
                                                     {0.013f, 0.198f},
                                                     {0.016f, 0.2f},
                                                     {0.016f, 0.218f},
                                                     {0.0005f, 0.22f}},
                                                    step),
                        segments, paint);
}

Mesh makeBowl() {
  const auto paint = [](const Eigen::Vector3f& p) -> Rgb {
    const float radius = p.head<2>().norm();
    if (p.z() > 0.006f && radius < 0.078f * std::sqrt(std::max(0.0f, p.z() - 0.005f) / 0.060f)) return {245, 235, 210};
    return p.z() > 0.05f ? Rgb{150, 40, 30} : Rgb{225, 110, 40};
  };
  std::vector<Eigen::Vector2f> profile{{0.0005f, 0}, {0.03f, 0}, {0.032f, 0.006f}};
  for (int i = 4; i <= 20; ++i) {
    const float fraction = float(i) / 20;
    profile.emplace_back(0.08f * std::sqrt(fraction), 0.065f * fraction);
  }
  for (int i = 20; i >= 0; --i) {
    const float fraction = float(i) / 20;
    profile.emplace_back(std::max(0.0005f, 0.0765f * std::sqrt(fraction)), 0.006f + 0.059f * fraction);
  }
  return makeRevolution(subdivided<Eigen::Vector2f>(profile, step), segments, paint);
}

}  // namespace sks
