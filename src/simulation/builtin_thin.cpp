// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "simulation/builtin_shapes.hpp"
#include "simulation/shapes.hpp"

namespace sks {
namespace {

constexpr float thickness = 0.013f;  // [m]
constexpr float half = 0.5f * thickness;
constexpr float ring = 0.002f;  // between rings of vertices, which carry the colours [m]

/// A rod along x at the height at which things of this thickness lie.
Mesh lengthwise(float from, float to, float from_radius, float to_radius, const Paint& paint) {
  return makeRod({from, 0, half}, {to, 0, half}, from_radius, to_radius, paint, ring);
}

}  // namespace

Mesh makeMarker() {
  const auto barrel = [](const Eigen::Vector3f& p) -> Rgb {
    const bool label = p.x() > -0.045f && p.x() < 0.01f && p.z() > half;
    if (label) return std::fmod(p.x() + 1, 0.012f) < 0.006f ? Rgb{20, 20, 20} : Rgb{250, 210, 50};
    return p.x() < -0.065f ? Rgb{200, 30, 40} : Rgb{240, 240, 240};
  };
  Mesh marker = lengthwise(-0.075f, 0.03f, half, half, barrel);
  append(marker, lengthwise(0.025f, 0.075f, half, 0.0055f, plain({200, 30, 40})));
  return marker;
}

Mesh makeScrewdriver() {
  const auto grip = [](const Eigen::Vector3f& p) -> Rgb {
    if (p.x() < -0.1f) return {30, 30, 30};
    return std::fmod(std::atan2(p.y(), p.z() - half) + 7, 1.5708f) < 0.7f ? Rgb{30, 30, 30} : Rgb{30, 110, 200};
  };
  Mesh screwdriver = lengthwise(-0.11f, -0.01f, half, half, grip);
  append(screwdriver, lengthwise(-0.01f, 0.0f, half, 0.004f, plain({30, 110, 200})));
  append(screwdriver, lengthwise(-0.005f, 0.11f, 0.003f, 0.003f, plain({165, 168, 172})));
  return screwdriver;
}

Mesh makeBrush() {
  const auto handle = [](const Eigen::Vector3f& p) -> Rgb {
    return p.x() < -0.1f ? Rgb{170, 40, 130} : Rgb{235, 190, 110};
  };
  Mesh brush = lengthwise(-0.125f, 0.055f, 0.004f, 0.006f, handle);
  append(brush, lengthwise(0.05f, 0.085f, 0.006f, half, plain({175, 178, 182})));
  append(brush, lengthwise(0.08f, 0.125f, half, 0.004f, plain({70, 45, 30})));
  return brush;
}

Mesh makeSpoon() {
  const auto wood = [](const Eigen::Vector3f& p) -> Rgb {
    if (p.x() < -0.12f) return {190, 40, 40};
    return std::abs(p.x() + 0.1f) < 0.006f ? Rgb{245, 245, 240} : Rgb{205, 160, 100};
  };
  Mesh spoon = lengthwise(-0.15f, 0.1f, 0.005f, 0.006f, wood);
  Mesh head = makeSphere(0.02f, 4, [](const Eigen::Vector3f& p) {
    return p.z() > 0 ? Rgb{205, 160, 100} : Rgb{170, 120, 70};
  });
  for (Eigen::Vector3f& v : head.vertices) v = v.cwiseProduct(Eigen::Vector3f(1.5f, 1, half / 0.02f));
  append(spoon, movedTo(std::move(head), 0.12f, 0, half));
  return spoon;
}

Mesh makeStick() {
  const auto bands = [](const Eigen::Vector3f& p) -> Rgb {  // of growing width, so that each place looks different
    const float along = std::sqrt(p.x() + 0.2f);
    if (p.x() > 0.17f) return {30, 90, 60};
    return std::fmod(along, 0.14f) < 0.07f ? Rgb{240, 120, 30} : Rgb{235, 235, 225};
  };
  return movedTo(makeBox({0.4f, thickness, thickness}, bands, ring), 0, 0, half);
}

}  // namespace sks
