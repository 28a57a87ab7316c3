// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/simulation/mesh.hpp>

namespace sks {

/// What Bullet needs to know about a mesh; made once and shared by all that is dropped.
class RigidBody {
public:
  explicit RigidBody(const Mesh& mesh);
  ~RigidBody();
  RigidBody(const RigidBody&) = delete;
  RigidBody& operator=(const RigidBody&) = delete;

  float radius() const { return radius_; }  ///< greatest distance of the mesh from its centre of mass [m]

private:
  friend class TablePhysics;
  struct Shape;
  std::unique_ptr<Shape> shape_;
  Eigen::Vector3f center_of_mass_;
  float radius_ = 0;
};

/// A table whose top is z = 0, and things that fall on it. Same calls, same result: one thread, fixed steps.
class TablePhysics {
public:
  /// @param half_size of the table's top along x and y [m]
  explicit TablePhysics(double half_size);
  ~TablePhysics();
  TablePhysics(const TablePhysics&) = delete;
  TablePhysics& operator=(const TablePhysics&) = delete;

  /// Lets a body fall from above all that is there, rotated by `rotation`, over (x, y), and waits until it lies.
  /// @return false if it did not stay within `region` [m] of the middle: it is gone then
  bool drop(const RigidBody& body, double x, double y, const Eigen::Quaterniond& rotation, double region);

  /// Waits until everything lies still. @return poses of the meshes that were dropped and stayed, in their order
  std::vector<Eigen::Isometry3d> settle();

private:
  struct World;
  std::unique_ptr<World> world_;
};

}  // namespace sks
