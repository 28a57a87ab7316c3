// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "simulation/builtin_shapes.hpp"
#include "simulation/shapes.hpp"

namespace sks {
namespace {

constexpr float fine = 0.001f;  // between vertices, which carry the colours [m]
constexpr int around = 60;      // segments

/// Whether a position on a face, from -1 to 1, lies on one of its pips.
bool onPip(int pips, float a, float b) {
  constexpr float radius = 0.22f, aside = 0.55f;
  const auto at = [&](float x, float y) { return std::hypot(a - x * aside, b - y * aside) < radius; };
  if (pips % 2 == 1 && at(0, 0)) return true;
  if (pips >= 2 && (at(-1, -1) || at(1, 1))) return true;
  if (pips >= 4 && (at(-1, 1) || at(1, -1))) return true;
  return pips == 6 && (at(-1, 0) || at(1, 0));
}

}  // namespace

Mesh makeDice() {
  constexpr float size = 0.03f;
  const auto paint = [](const Eigen::Vector3f& p) -> Rgb {
    constexpr Rgb bodies[] = {{200, 30, 30},  {245, 245, 240}, {30, 60, 170},
                              {250, 205, 40}, {30, 130, 60},   {40, 40, 45}};
    int axis = 0;
    p.cwiseAbs().maxCoeff(&axis);
    const int face = 2 * axis + (p[axis] > 0 ? 1 : 0);
    const float a = 2 * p[(axis + 1) % 3] / size, b = 2 * p[(axis + 2) % 3] / size;
    if (!onPip(face + 1, a, b)) return bodies[face];
    return face == 1 || face == 3 ? Rgb{20, 20, 20} : Rgb{250, 250, 250};
  };
  return movedTo(makeBox({size, size, size}, paint, fine), 0, 0, 0.5f * size);
}

Mesh makeBall() {
  constexpr float radius = 0.018f;
  const auto paint = [](const Eigen::Vector3f& p) -> Rgb {
    if (p.x() > 0.8f * radius) return {250, 250, 245};
    if (p.x() < -0.85f * radius) return {30, 30, 120};
    const float angle = std::atan2(p.y(), p.z());
    return std::fmod(angle + 2 * float(EIGEN_PI), 1.5708f) < 0.8f ? Rgb{235, 120, 20} : Rgb{20, 130, 140};
  };
  return movedTo(makeSphere(radius, 5, paint), 0, 0, radius);
}

Mesh makeMatchbox() {
  const Eigen::Vector3f size(0.04f, 0.03f, 0.018f);
  const auto paint = [size](const Eigen::Vector3f& p) -> Rgb {
    const float x = p.x() / size.x(), y = p.y() / size.y();
    if (std::abs(p.y()) > 0.499f * size.y()) return {90, 50, 40};     // to strike matches
    if (std::abs(p.x()) > 0.499f * size.x()) return {235, 225, 200};  // the drawer
    if (p.z() < 0) return y > 0.1f ? Rgb{235, 225, 200} : Rgb{190, 30, 45};
    if (std::hypot(x + 0.2f, 0.75f * y) < 0.2f) return {250, 220, 60};  // a sun beside a sail
    return x > 0.05f && y < x - 0.05f ? Rgb{250, 250, 250} : Rgb{30, 80, 160};
  };
  return movedTo(makeBox(size, paint, fine), 0, 0, 0.5f * size.z());
}

Mesh makeSpool() {
  const auto paint = [](const Eigen::Vector3f& p) -> Rgb {
    const float radius = p.head<2>().norm();
    if (radius > 0.0115f) return p.z() > 0.016f ? Rgb{230, 200, 150} : Rgb{150, 100, 50};
    if (p.z() < 0.003f || p.z() > 0.029f) return radius < 0.005f ? Rgb{250, 250, 250} : Rgb{200, 160, 100};
    return p.z() > 0.016f ? Rgb{210, 30, 110} : Rgb{250, 150, 190};
  };
  return makeRevolution(subdivided<Eigen::Vector2f>({{0.0005f, 0},
                                                     {0.016f, 0},
                                                     {0.016f, 0.004f},
                                                     {0.011f, 0.006f},
                                                     {0.011f, 0.026f},
                                                     {0.016f, 0.028f},
                                                     {0.016f, 0.032f},
                                                     {0.0005f, 0.032f}},
                                                    fine),
                        around, paint);
}

Mesh makePawn() {
  const auto paint = [](const Eigen::Vector3f& p) -> Rgb {
    if (p.z() > 0.026f) return {250, 235, 90};
    if (p.z() < 0.006f) return {30, 30, 30};
    return std::abs(p.z() - 0.016f) < 0.003f ? Rgb{250, 250, 250} : Rgb{60, 150, 50};
  };
  Mesh pawn =
      makeRevolution(subdivided<Eigen::Vector2f>(
                         {{0.0005f, 0}, {0.0135f, 0}, {0.0135f, 0.006f}, {0.006f, 0.026f}, {0.0005f, 0.026f}}, fine),
                     around, paint);
  append(pawn, movedTo(makeSphere(0.008f, 4, plain({250, 235, 90})), 0, 0, 0.031f));
  return pawn;
}

}  // namespace sks
