// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include <sks_detector/error.hpp>

#include "io/nearest_rotation.hpp"
#include "tools/import/bop_files.hpp"
#include "tools/import/bop_json.hpp"

namespace sks::tools {
namespace {

Eigen::Isometry3d discreteSymmetry(const BopNode& node) {
  const std::vector<double> values = node.numbers(16);
  const Eigen::Matrix4d matrix = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data());
  const NearestRotation nearest = nearestRotation(matrix.topLeftCorner<3, 3>());
  if (!nearest.fault.empty()) throw Error(ErrorCode::bad_data, node.where + ": " + nearest.fault);
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = nearest.rotation;
  motion.translation() = matrix.topRightCorner<3, 1>();
  return motion;
}

ObjectSymmetries::Axis continuousSymmetry(const BopNode& node) {
  ObjectSymmetries::Axis axis;
  axis.direction = Eigen::Vector3d(node.at("axis").numbers(3).data());
  if (axis.direction.norm() < 1e-9) throw Error(ErrorCode::bad_data, node.where + ", axis: must have a length");
  axis.direction.normalize();
  if (node.value.contains("offset")) axis.position = Eigen::Vector3d(node.at("offset").numbers(3).data());
  return axis;
}

/// What training uses: the symmetry about one axis.
std::optional<Symmetry> singleAxis(const ObjectSymmetries& all) {
  if (!all.continuous.empty()) return Symmetry{all.continuous[0].direction, 0};
  if (all.discrete.empty()) return std::nullopt;
  std::vector<Eigen::Vector3d> axes;
  for (const Eigen::Isometry3d& motion : all.discrete) axes.push_back(Eigen::AngleAxisd(motion.linear()).axis());
  const auto parallel = [&](const Eigen::Vector3d& axis) { return std::abs(axis.dot(axes[0])) > 0.999; };
  if (!std::all_of(axes.begin(), axes.end(), parallel)) return std::nullopt;
  return Symmetry{axes[0], int(axes.size()) + 1};
}

}  // namespace

std::map<int, BopModelInfo> readBopModelInfo(const std::filesystem::path& models) {
  std::map<int, BopModelInfo> result;
  const std::filesystem::path file = models / "models_info.json";
  if (!std::filesystem::exists(file)) return result;
  const nlohmann::json content = readBopJson(file);
  for (const auto& [key, value] : content.items()) {
    const BopNode model{value, file.string() + ": object " + key};
    BopModelInfo info;
    if (value.contains("diameter")) info.diameter = model.at("diameter").number();
    ObjectSymmetries all;
    for (const BopNode& item : model.list("symmetries_discrete")) all.discrete.push_back(discreteSymmetry(item));
    for (const BopNode& item : model.list("symmetries_continuous")) all.continuous.push_back(continuousSymmetry(item));
    info.symmetry = singleAxis(all);
    if (!all.discrete.empty() || !all.continuous.empty()) info.symmetries = std::move(all);
    result[bopId(key, file)] = std::move(info);
  }
  return result;
}

}  // namespace sks::tools
