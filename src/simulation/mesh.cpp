// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/simulation/mesh.hpp>

#include <cmath>

namespace sks {
namespace {

constexpr Rgb uncolored{180, 180, 180};

}  // namespace

Eigen::AlignedBox3f Mesh::box() const {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3i& t : triangles) {
    for (int k = 0; k < 3; ++k) box.extend(vertices[std::size_t(t[k])]);
  }
  return box;
}

Eigen::Vector3f Mesh::areaVector(std::size_t triangle) const {
  const Eigen::Vector3i& t = triangles[triangle];
  const Eigen::Vector3f& a = vertices[std::size_t(t[0])];
  return 0.5f * (vertices[std::size_t(t[1])] - a).cross(vertices[std::size_t(t[2])] - a);
}

Eigen::Vector3f Mesh::point(std::size_t triangle, float u, float v) const {
  const Eigen::Vector3i& t = triangles[triangle];
  return (1 - u - v) * vertices[std::size_t(t[0])] + u * vertices[std::size_t(t[1])] + v * vertices[std::size_t(t[2])];
}

Rgb Mesh::color(std::size_t triangle, float u, float v, float footprint) const {
  const Eigen::Vector3i& t = triangles[triangle];
  const float w = 1 - u - v;
  const int image = triangle_texture.empty() ? -1 : triangle_texture[triangle];
  if (image >= 0) {
    const Eigen::Vector2f &a = texture_uv[std::size_t(t[0])], &b = texture_uv[std::size_t(t[1])],
                          &c = texture_uv[std::size_t(t[2])];
    const Eigen::Vector2f uv = w * a + u * b + v * c;
    const Texture& texture = textures[std::size_t(image)];
    const Eigen::Vector2f ab = b - a, ac = c - a;
    const float texels =
        0.5f * std::abs(ab.x() * ac.y() - ab.y() * ac.x()) * float(texture.width()) * float(texture.height());
    const float area = areaVector(triangle).norm();
    const float per_metre = area > 0 ? std::sqrt(texels / area) : 0;
    return texture.at(uv.x(), uv.y(), footprint * per_metre);
  }
  if (colors.empty()) return uncolored;
  const Rgb &a = colors[std::size_t(t[0])], &b = colors[std::size_t(t[1])], &c = colors[std::size_t(t[2])];
  const auto mix = [&](float p, float q, float r) { return std::uint8_t(std::lround(w * p + u * q + v * r)); };
  return {mix(a.r, b.r, c.r), mix(a.g, b.g, c.g), mix(a.b, b.b, c.b)};
}

}  // namespace sks
