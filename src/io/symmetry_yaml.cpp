// SPDX-License-Identifier: BSD-3-Clause
#include "io/symmetry_yaml.hpp"

#include <cmath>

#include <Eigen/SVD>

namespace sks {
namespace {

constexpr double rigid_tolerance = 1e-3;  // of each entry of R^T R - I and of the last row
constexpr std::size_t most_discrete = 1000, most_continuous = 10;

Eigen::Vector3d unitAxis(const YamlMap& map) {
  const std::vector<double> axis = map.numbers("axis", 3);
  const Eigen::Vector3d direction(axis[0], axis[1], axis[2]);
  if (direction.norm() < 1e-9) map.fail("axis", "must have a length");
  return direction.normalized();
}

std::vector<YAML::Node> limitedList(const YamlMap& map, const std::string& key, std::size_t most) {
  std::vector<YAML::Node> items = map.list(key);
  if (items.size() > most) map.fail(key, "has more than " + std::to_string(most) + " items");
  return items;
}

}  // namespace

Symmetry readSymmetry(const YamlMap& entry) {
  const YamlMap part(entry.at("symmetry"), entry.file(), "a symmetry", {"axis", "order"});
  Symmetry symmetry;
  symmetry.axis = unitAxis(part);
  if (part.text("order") == "inf") return symmetry;
  const double order = part.number("order");
  if (order < 2 || order > 1000 || order != std::floor(order)) {
    part.fail("order", "must be a whole number from 2 to 1000, or inf for a body of revolution");
  }
  symmetry.order = int(order);
  return symmetry;
}

std::optional<ObjectSymmetries> readSymmetries(const YamlMap& entry, double scale) {
  if (!entry.has("symmetries_discrete") && !entry.has("symmetries_continuous")) return std::nullopt;
  ObjectSymmetries symmetries;
  for (const YAML::Node& item : limitedList(entry, "symmetries_discrete", most_discrete)) {
    const YamlMap part(item, entry.file(), "a discrete symmetry", {"pose"});
    symmetries.discrete.push_back(readRigidMotion(part, "pose"));
    symmetries.discrete.back().translation() *= scale;
  }
  for (const YAML::Node& item : limitedList(entry, "symmetries_continuous", most_continuous)) {
    const YamlMap part(item, entry.file(), "a continuous symmetry", {"axis", "offset"});
    ObjectSymmetries::Axis axis;
    axis.direction = unitAxis(part);
    if (part.has("offset")) axis.position = scale * Eigen::Vector3d(part.numbers("offset", 3).data());
    symmetries.continuous.push_back(axis);
  }
  return symmetries;
}

Eigen::Isometry3d readRigidMotion(const YamlMap& map, const std::string& key) {
  const std::vector<double> values = map.numbers(key, 16);
  const Eigen::Matrix4d matrix = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data());
  if ((matrix.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff() > rigid_tolerance) {
    map.fail(key, "must end with 0, 0, 0, 1: 16 numbers, row-major, of a rigid motion");
  }
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  const double skew = (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (skew > rigid_tolerance || rotation.determinant() < 0) {
    map.fail(key, "is not rigid: its upper left 3 x 3 numbers must be a rotation, without scale or mirroring");
  }
  // printed digits leave the rotation a little skew; inverting it as a rigid transform needs an exact one
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(rotation, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = svd.matrixU() * svd.matrixV().transpose();
  motion.translation() = matrix.topRightCorner<3, 1>();
  return motion;
}

}  // namespace sks
