// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/table_physics.hpp"

#include <algorithm>
#include <cmath>

#include <btBulletDynamicsCommon.h>

#include "simulation/convex_parts.hpp"

namespace sks {
namespace {

// Bullet is made for things of about a metre: lengths are ten times the real ones.
constexpr double units = 10;              // [1 / m]
constexpr double margin = 0.001 * units;  // around shapes
constexpr double time_step = 1.0 / 240;   // [s]
constexpr int fall_steps = 240;           // in which a dropped body comes to lie
constexpr int settle_steps = 1200;        // at most, at the end
constexpr double mass = 0.3;              // [kg]
constexpr double still = 0.005 * units;   // speed below which things lie [units / s], rotations [rad / s]

btVector3 toBullet(const Eigen::Vector3d& v) {
  return {btScalar(units * v.x()), btScalar(units * v.y()), btScalar(units * v.z())};
}

/// Mean of the surface: of things of even walls the centre of mass.
Eigen::Vector3f surfaceMean(const Mesh& mesh) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const double weight = double(mesh.areaVector(t).norm());
    sum += weight * mesh.point(t, 1.0f / 3, 1.0f / 3).cast<double>();
    area += weight;
  }
  return (area > 0 ? Eigen::Vector3d(sum / area) : mesh.box().center().cast<double>()).cast<float>();
}

}  // namespace

struct RigidBody::Shape {
  std::vector<std::unique_ptr<btConvexHullShape>> hulls;
  btCompoundShape compound;
};

RigidBody::RigidBody(const Mesh& mesh) : shape_(std::make_unique<Shape>()), center_of_mass_(surfaceMean(mesh)) {
  for (const Eigen::Vector3f& v : mesh.vertices) radius_ = std::max(radius_, (v - center_of_mass_).norm());
  for (const std::vector<Eigen::Vector3f>& part : convexParts(mesh)) {
    auto hull = std::make_unique<btConvexHullShape>();
    const std::vector<Eigen::Vector3f> corners = hullCorners(part);
    for (const Eigen::Vector3f& p : corners.empty() ? part : corners) {
      hull->addPoint(toBullet((p - center_of_mass_).cast<double>()), false);
    }
    hull->recalcLocalAabb();
    hull->setMargin(btScalar(margin));
    shape_->compound.addChildShape(btTransform::getIdentity(), hull.get());
    shape_->hulls.push_back(std::move(hull));
  }
  shape_->compound.setMargin(btScalar(margin));
}

RigidBody::~RigidBody() = default;

struct TablePhysics::World {
  struct Thing {
    std::unique_ptr<btDefaultMotionState> motion;
    std::unique_ptr<btRigidBody> body;
    Eigen::Vector3d center_of_mass;  // in the mesh's frame [m]
  };

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  std::unique_ptr<btBoxShape> table;
  std::vector<Thing> things;

  ~World() {
    for (Thing& thing : things) world.removeRigidBody(thing.body.get());
  }

  void add(btCollisionShape* shape, double weight, const btTransform& pose, const Eigen::Vector3d& center) {
    btVector3 inertia(0, 0, 0);
    if (weight > 0) shape->calculateLocalInertia(btScalar(weight), inertia);
    Thing thing;
    thing.motion = std::make_unique<btDefaultMotionState>(pose);
    btRigidBody::btRigidBodyConstructionInfo info(btScalar(weight), thing.motion.get(), shape, inertia);
    info.m_friction = btScalar(0.7);
    info.m_rollingFriction = btScalar(0.02);
    info.m_linearDamping = btScalar(0.05);
    info.m_angularDamping = btScalar(0.2);
    thing.body = std::make_unique<btRigidBody>(info);
    thing.body->setActivationState(DISABLE_DEACTIVATION);
    thing.center_of_mass = center;
    world.addRigidBody(thing.body.get());
    things.push_back(std::move(thing));
  }
  void removeLast() {
    world.removeRigidBody(things.back().body.get());
    things.pop_back();
  }
  void step() { world.stepSimulation(btScalar(time_step), 0); }

  double top() const {  // of everything [units]
    btScalar highest = 0;
    for (const Thing& thing : things) {
      btVector3 low, high;
      thing.body->getAabb(low, high);
      highest = std::max(highest, high.z());
    }
    return double(highest);
  }
  bool isStill() const {
    return std::all_of(things.begin(), things.end(), [](const Thing& thing) {
      return double(thing.body->getLinearVelocity().length()) < still &&
             double(thing.body->getAngularVelocity().length()) < still;
    });
  }
};

TablePhysics::TablePhysics(double half_size) : world_(std::make_unique<World>()) {
  World& w = *world_;
  w.world.setGravity(toBullet({0, 0, -9.81}));
  const double half_thickness = 0.05;
  w.table = std::make_unique<btBoxShape>(toBullet({half_size, half_size, half_thickness}));
  w.table->setMargin(btScalar(margin));
  btTransform pose = btTransform::getIdentity();
  pose.setOrigin(toBullet({0, 0, -half_thickness}));
  w.add(w.table.get(), 0, pose, Eigen::Vector3d::Zero());
}

TablePhysics::~TablePhysics() = default;

bool TablePhysics::drop(const RigidBody& body, double x, double y, const Eigen::Quaterniond& rotation, double region) {
  World& w = *world_;
  const double height = w.top() + units * (double(body.radius_) + 0.02);
  const btQuaternion turn(btScalar(rotation.x()), btScalar(rotation.y()), btScalar(rotation.z()),
                          btScalar(rotation.w()));
  const btTransform pose(turn, btVector3(btScalar(units * x), btScalar(units * y), btScalar(height)));
  w.add(&body.shape_->compound, mass, pose, body.center_of_mass_.cast<double>());
  for (int i = 0; i < fall_steps; ++i) w.step();
  const btVector3& p = w.things.back().body->getWorldTransform().getOrigin();
  const bool stays = p.z() > 0 && std::hypot(double(p.x()), double(p.y())) < units * region;
  if (!stays) w.removeLast();
  return stays;
}

std::vector<Eigen::Isometry3d> TablePhysics::settle() {
  World& w = *world_;
  for (int i = 0; i < settle_steps && !w.isStill(); ++i) w.step();
  std::vector<Eigen::Isometry3d> poses;
  for (std::size_t i = 1; i < w.things.size(); ++i) {  // the first is the table
    const btTransform& moved = w.things[i].body->getWorldTransform();
    const btVector3& p = moved.getOrigin();
    const btQuaternion q = moved.getRotation();
    Eigen::Isometry3d pose(Eigen::Translation3d(double(p.x()) / units, double(p.y()) / units, double(p.z()) / units));
    pose.rotate(Eigen::Quaterniond(double(q.w()), double(q.x()), double(q.y()), double(q.z())).normalized());
    poses.push_back(pose * Eigen::Translation3d(-w.things[i].center_of_mass));
  }
  return poses;
}

}  // namespace sks
