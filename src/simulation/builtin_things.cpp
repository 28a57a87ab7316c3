// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "simulation/builtin_shapes.hpp"
#include "simulation/shapes.hpp"

namespace sks {
namespace {

constexpr float cell = 0.003f;  // between vertices, which carry the colours [m]

Mesh stretched(Mesh mesh, const Eigen::Vector3f& factors) {
  for (Eigen::Vector3f& v : mesh.vertices) v = v.cwiseProduct(factors);
  return mesh;
}

}  // namespace

Mesh makePrintedBox() {
  const Eigen::Vector3f size(0.14f, 0.055f, 0.19f);
  const auto paint = [size](const Eigen::Vector3f& p) -> Rgb {
    const float x = p.x() / size.x() + 0.5f, z = p.z() / size.z() + 0.5f;
    if (p.y() < -0.499f * size.y()) {  // the front: a sun over hills under a title
      if (z > 0.8f)
        return std::fmod(x * 7, 1.0f) < 0.6f && x > 0.1f && x < 0.9f && z < 0.92f ? Rgb{255, 240, 90}
                                                                                  : Rgb{170, 20, 40};
      if (std::hypot((x - 0.7f) * size.x(), (z - 0.6f) * size.z()) < 0.02f) return {255, 150, 30};
      return z < 0.35f + 0.1f * std::sin(9 * x) ? Rgb{60, 140, 60} : Rgb{150, 200, 240};
    }
    if (p.y() > 0.499f * size.y()) {  // the back: lines of print
      return std::fmod(z * 14, 1.0f) < 0.45f && x > 0.15f &&
                     x < 0.5f + 0.35f * std::abs(std::sin(40 * std::floor(z * 14)))
                 ? Rgb{50, 50, 60}
                 : Rgb{235, 230, 215};
    }
    if (std::abs(p.x()) > 0.499f * size.x()) return z > 0.5f ? Rgb{170, 20, 40} : Rgb{240, 200, 60};
    return p.z() > 0 ? Rgb{170, 20, 40} : Rgb{120, 100, 80};
  };
  return movedTo(makeBox(size, paint, cell), 0, 0, 0.5f * size.z());
}

Mesh makeDrill() {
  const Rgb black{35, 35, 40}, yellow{245, 190, 20}, steel{150, 150, 155}, red{200, 40, 30};
  Mesh drill = movedTo(
      makeBox(
          {0.085f, 0.065f, 0.028f}, [=](const Eigen::Vector3f& p) { return p.x() > 0.02f ? red : black; }, cell),
      0.005f, 0, 0.014f);
  append(drill, makeRod({0, 0, 0.02f}, {0.008f, 0, 0.125f}, 0.019f, 0.017f, plain(black)));
  append(drill, makeRod({-0.055f, 0, 0.145f}, {0.065f, 0, 0.145f}, 0.029f, 0.027f, [=](const Eigen::Vector3f& p) {
           return p.x() < -0.035f || (p.z() > 0.16f && p.x() < 0.02f) ? black : yellow;
         }));
  append(drill, makeRod({0.06f, 0, 0.145f}, {0.1f, 0, 0.145f}, 0.02f, 0.012f, plain(black)));
  append(drill, makeRod({0.095f, 0, 0.145f}, {0.15f, 0, 0.145f}, 0.004f, 0.004f, plain(steel)));
  append(drill, movedTo(makeBox({0.012f, 0.014f, 0.03f}, plain(red), cell), 0.026f, 0, 0.105f));
  return drill;
}

Mesh makeDuck() {
  const Rgb yellow{250, 215, 50}, orange{240, 120, 20}, brown{120, 80, 30}, black{20, 20, 20};
  Mesh duck = movedTo(stretched(makeSphere(0.05f, 5,
                                           [=](const Eigen::Vector3f& p) {
                                             const bool wing =
                                                 std::abs(p.y()) > 0.034f && std::abs(p.z()) < 0.02f && p.x() < 0.015f;
                                             return wing ? brown : yellow;
                                           }),
                                {1.15f, 0.85f, 0.75f}),
                      0, 0, 0.0375f);
  append(duck, movedTo(makeSphere(0.031f, 5,
                                  [=](const Eigen::Vector3f& p) {
                                    const bool eye = std::hypot(p.x() - 0.019f, p.z() - 0.009f) < 0.006f;
                                    return eye ? black : yellow;
                                  }),
                       0.03f, 0, 0.092f));
  append(duck, movedTo(stretched(makeSphere(0.016f, 4, plain(orange)), {1.1f, 1, 0.4f}), 0.064f, 0, 0.087f));
  append(duck, makeRod({-0.045f, 0, 0.045f}, {-0.074f, 0, 0.072f}, 0.022f, 0.004f, plain(yellow)));
  return duck;
}

}  // namespace sks
