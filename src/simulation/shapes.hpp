// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include <sks_detector/simulation/mesh.hpp>

namespace sks {

/// Colour of a position on a shape [m].
using Paint = std::function<Rgb(const Eigen::Vector3f&)>;

/// The same colour everywhere.
Paint plain(const Rgb& color);

/// A box around the origin whose faces are cut into squares of about `cell`, so that their vertices carry a pattern.
Mesh makeBox(const Eigen::Vector3f& size, const Paint& paint, float cell = 1);

/// A sphere around the origin: an icosahedron whose triangles are cut in four `subdivisions` times.
Mesh makeSphere(float radius, int subdivisions, const Paint& paint);

/// The surface that a line turned about the z axis sweeps. @param profile points (distance from the axis, z) [m]
Mesh makeRevolution(const std::vector<Eigen::Vector2f>& profile, int segments, const Paint& paint);

/// A tube along a path, with closed ends. @param radius of each point of the path [m]
Mesh makeTube(const std::vector<Eigen::Vector3f>& path, const std::vector<float>& radius, int segments,
              const Paint& paint);

/// A closed cylinder or cone from one point to another. @param step between its rings [m]
Mesh makeRod(const Eigen::Vector3f& from, const Eigen::Vector3f& to, float from_radius, float to_radius,
             const Paint& paint, float step = 0.01f);

/// A line through the given points with steps of at most `step` [m], for profiles and paths.
template <typename Point>
std::vector<Point> subdivided(const std::vector<Point>& points, float step);

/// Adds the triangles of a mesh without textures to another one, both with colours at their vertices.
void append(Mesh& mesh, const Mesh& more);

/// Moves a mesh.
Mesh transformed(Mesh mesh, const Eigen::Isometry3f& transform);
Mesh movedTo(Mesh mesh, float x, float y, float z);

/// Directions that are spread evenly: the vertices of a subdivided icosahedron for 12, 42, 162, 642 and 2562 of them,
/// points of a spiral for other counts.
std::vector<Eigen::Vector3d> geodesicDirections(int count);

}  // namespace sks
