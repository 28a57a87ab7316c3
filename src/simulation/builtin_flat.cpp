// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "simulation/builtin_shapes.hpp"
#include "simulation/shapes.hpp"

namespace sks {
namespace {

constexpr float height = 0.006f;  // of all of them [m]
constexpr float dot = 0.002f;     // between vertices, which carry the colours [m]

/// A plate on z = 0, whose `front` lies above. Prints are functions of the position [m]; the rim has one colour.
Mesh printedPlate(float x, float y, const Paint& front, const Paint& back, const Rgb& rim) {
  const auto paint = [=](const Eigen::Vector3f& p) {
    if (std::abs(p.z()) < 0.499f * height) return rim;
    return p.z() > 0 ? front(p) : back(p);
  };
  return movedTo(makeBox({x, y, height}, paint, dot), 0, 0, 0.5f * height);
}

/// Lines of text of different lengths.
bool onText(float x, float y, float left, float right, float spacing) {
  const float line = std::floor(y / spacing);
  return y / spacing - line < 0.45f && x > left &&
         x < left + (right - left) * (0.6f + 0.4f * std::abs(std::sin(7 * line)));
}

bool inside(const Eigen::Vector3f& p, float left, float right, float low, float high) {
  return p.x() > left && p.x() < right && p.y() > low && p.y() < high;
}

}  // namespace

Mesh makeCard() {
  const auto front = [](const Eigen::Vector3f& p) -> Rgb {  // a stripe, a portrait and a name
    if (p.y() > 0.024f) return {20, 60, 140};
    if (inside(p, -0.02f, 0.0f, -0.008f, 0.018f)) {
      return std::hypot(p.x() + 0.01f, p.y() - 0.007f) < 0.006f ? Rgb{230, 180, 150} : Rgb{130, 190, 220};
    }
    return onText(p.x(), p.y() + 0.04f, -0.02f, 0.02f, 0.007f) && p.y() < -0.012f ? Rgb{40, 40, 40}
                                                                                  : Rgb{240, 240, 235};
  };
  const auto back = [](const Eigen::Vector3f& p) -> Rgb {
    return std::abs(p.y() - 0.018f) < 0.007f ? Rgb{30, 30, 30} : Rgb{200, 205, 215};
  };
  return printedPlate(0.05f, 0.08f, front, back, {225, 225, 225});
}

Mesh makeCoaster() {
  const auto front = [](const Eigen::Vector3f& p) -> Rgb {  // three petals in a ring
    const float radius = p.head<2>().norm(), angle = std::atan2(p.y(), p.x());
    if (radius > 0.042f) return {150, 30, 30};
    if (radius < 0.036f * std::abs(std::cos(1.5f * angle))) return angle > 0 ? Rgb{250, 190, 40} : Rgb{40, 120, 60};
    return {245, 235, 215};
  };
  const auto paint = [front](const Eigen::Vector3f& p) -> Rgb {
    if (p.z() > height - 0.0005f) return front(p);
    return {190, 150, 100};  // cork
  };
  return makeRevolution(
      subdivided<Eigen::Vector2f>({{0.0005f, 0}, {0.05f, 0}, {0.05f, height}, {0.0005f, height}}, dot), 150, paint);
}

Mesh makeTile() {
  const auto front = [](const Eigen::Vector3f& p) -> Rgb {  // an ornament that no rotation maps onto itself
    const float u = p.x() / 0.06f, v = p.y() / 0.06f;
    if (std::max(std::abs(u), std::abs(v)) > 0.85f) return {30, 70, 150};
    if (std::abs(std::hypot(u - 0.85f, v - 0.85f) - 0.9f) < 0.12f) return {220, 150, 40};
    if (std::hypot(u + 0.35f, v + 0.35f) < 0.28f) return {30, 70, 150};
    return {245, 245, 240};
  };
  return printedPlate(0.12f, 0.12f, front, plain({180, 90, 60}), {210, 200, 190});
}

Mesh makeBooklet() {
  const auto front = [](const Eigen::Vector3f& p) -> Rgb {  // a title over a landscape
    if (p.y() > 0.06f) return inside(p, -0.055f, 0.04f, 0.072f, 0.088f) ? Rgb{255, 255, 255} : Rgb{190, 40, 50};
    if (std::hypot(p.x() - 0.035f, p.y() - 0.03f) < 0.018f) return {255, 200, 50};
    if (p.y() < -0.03f + 0.02f * std::sin(60 * p.x())) return p.x() > 0 ? Rgb{50, 110, 50} : Rgb{90, 150, 60};
    return {150, 200, 235};
  };
  const auto back = [](const Eigen::Vector3f& p) -> Rgb {
    if (inside(p, 0.02f, 0.06f, -0.09f, -0.065f))
      return std::fmod(p.x() * 400, 2.0f) < 1 ? Rgb{20, 20, 20} : Rgb{255, 255, 255};
    return p.y() > -0.05f && onText(p.x(), p.y() + 0.1f, -0.06f, 0.06f, 0.012f) ? Rgb{70, 60, 60} : Rgb{245, 235, 210};
  };
  return printedPlate(0.15f, 0.2f, front, back, {235, 230, 220});
}

Mesh makeTablet() {
  const auto front = [](const Eigen::Vector3f& p) -> Rgb {  // rows of icons
    if (std::abs(p.x()) > 0.057f || std::abs(p.y()) > 0.078f) return {25, 25, 28};
    if (p.y() < -0.06f) return {70, 75, 90};
    const float column = std::floor((p.x() + 0.057f) / 0.0285f), row = std::floor((p.y() + 0.06f) / 0.046f);
    const bool icon =
        std::hypot(p.x() + 0.057f - 0.0285f * (column + 0.5f), p.y() + 0.06f - 0.046f * (row + 0.5f)) < 0.01f;
    if (!icon) return {35, 90, 165};
    constexpr Rgb icons[] = {{240, 80, 60}, {250, 210, 70}, {90, 200, 100}, {240, 240, 245}, {180, 90, 200}};
    return icons[int(column + 3 * row) % 5];
  };
  const auto back = [](const Eigen::Vector3f& p) -> Rgb {
    return std::hypot(p.x() + 0.05f, p.y() - 0.075f) < 0.006f ? Rgb{20, 20, 25} : Rgb{165, 168, 175};
  };
  return printedPlate(0.13f, 0.18f, front, back, {60, 60, 65});
}

}  // namespace sks
