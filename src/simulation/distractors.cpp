// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/distractors.hpp"

#include <vector>

#include "simulation/prints.hpp"
#include "simulation/scene_random.hpp"
#include "simulation/shapes.hpp"

namespace sks {
namespace {

constexpr float print_step = 0.003f;  // between vertices, which carry the colours [m]
constexpr int segments_around = 72;   // segments

Mesh turned(const std::vector<Eigen::Vector2f>& profile, const Paint& paint) {
  return makeRevolution(subdivided<Eigen::Vector2f>(profile, print_step), segments_around, paint);
}

}  // namespace

Mesh plainDistractor(PixelRandom& random) {
  const Paint paint = plain(anyColor(random, 20, 240));
  const auto length = [&](double low, double high) { return float(between(random, low, high)); };
  const std::size_t kind = below(random, 3);
  if (kind == 0) {
    const float a = length(0.03, 0.12), b = length(0.03, 0.12);
    return makeBox({a, b, length(0.02, 0.1)}, paint, 0.02f);
  }
  if (kind == 1) return makeSphere(length(0.02, 0.045), 3, paint);
  const float radius = length(0.015, 0.04), half = 0.5f * length(0.04, 0.16);
  const auto path = subdivided<Eigen::Vector3f>({{0, 0, -half}, {0, 0, half}}, 0.02f);
  return makeTube(path, std::vector<float>(path.size(), radius), 32, paint);
}

Mesh packageDistractor(PixelRandom& random) {
  const auto length = [&](double low, double high) { return float(between(random, low, high)); };
  const std::size_t kind = below(random, 6);
  if (kind == 0) {  // a carton
    const float a = length(0.06, 0.17), b = length(0.03, 0.08), c = length(0.08, 0.22);
    return makeBox({a, b, c}, packagePrint(random, c), print_step);
  }
  if (kind == 1) {  // a can
    const float radius = length(0.03, 0.052), height = length(0.035, 0.14);
    const Paint label = packagePrint(random, height);
    const auto paint = [=](const Eigen::Vector3f& p) -> Rgb {
      return p.z() > 0.003f && p.z() < height - 0.003f ? label({p.x(), p.y(), 0.9f * p.z() - 0.5f * height})
                                                       : Rgb{175, 175, 180};
    };
    return turned({{0.0005f, 0}, {radius, 0}, {radius, height}, {0.0005f, height}}, paint);
  }
  if (kind == 2) {  // a bottle
    const float radius = length(0.025, 0.045), height = length(0.15, 0.26), neck = length(0.01, 0.016);
    const Rgb body = anyColor(random, 20, 240), cap = anyColor(random, 20, 240);
    const Paint label = packagePrint(random, 0.4f * height);
    const auto paint = [=](const Eigen::Vector3f& p) -> Rgb {
      if (p.z() > 0.9f * height) return cap;
      return p.z() > 0.15f * height && p.z() < 0.55f * height && p.x() > 0
                 ? label({p.x(), p.y(), p.z() - 0.35f * height})
                 : body;
    };
    return turned({{0.0005f, 0},
                   {radius, 0.004f},
                   {radius, 0.6f * height},
                   {neck, 0.8f * height},
                   {neck, height},
                   {0.0005f, height}},
                  paint);
  }
  if (kind == 3) {  // a book
    const float a = length(0.1, 0.18), b = length(0.14, 0.25);
    return makeBox({a, b, length(0.012, 0.035)}, packagePrint(random, b), print_step);
  }
  if (kind == 4) {  // a cup
    const float radius = length(0.03, 0.045), height = length(0.07, 0.11), wall = 0.004f;
    const Rgb inside = anyColor(random, 150, 250);
    const Paint outside = packagePrint(random, height);
    const auto paint = [=](const Eigen::Vector3f& p) -> Rgb {
      const bool within = p.z() > 0.003f && p.head<2>().norm() < radius - 0.5f * wall;
      return within ? inside : outside({p.x(), p.y(), p.z() - 0.5f * height});
    };
    return turned(
        {{0.0005f, 0}, {radius, 0}, {radius, height}, {radius - wall, height}, {radius - wall, wall}, {0.0005f, wall}},
        paint);
  }
  const float radius = length(0.02, 0.05);  // a ball
  return makeSphere(radius, 5, packagePrint(random, 2 * radius));
}

}  // namespace sks
