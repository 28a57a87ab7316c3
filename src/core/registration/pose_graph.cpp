// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/pose_graph.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Eigenvalues>

#include <ceres/ceres.h>
#include <ceres/rotation.h>

namespace sks {
namespace {

// What an edge is off by beyond the noise of single points: the camera's calibration and smooth errors of its depth.
constexpr double common_turn = 0.005, common_shift = 0.0007;  // [rad], [m]
constexpr double unknown_turn = 1, unknown_shift = 0.1;       // of what an edge says nothing about
constexpr double plane_tilt = 0.01, plane_offset = 0.002;     // of the plane of one view [rad], [m]
constexpr double held = 1e-6;                                 // of the fixed view [rad], [m]
constexpr double outlier = 2;                                 // standard deviations from which on edges count less
constexpr int most_iterations = 50;

using Motion = std::array<double, 6>;  // turn (angle-axis) about `center` of the node in the model, then shift

/// A node's pose after its motion.
template <typename T>
void poseAfter(const PoseNode& node, const T* motion, Eigen::Matrix<T, 3, 3>& R, Eigen::Matrix<T, 3, 1>& t) {
  Eigen::Matrix<T, 3, 3> turn;
  ceres::AngleAxisToRotationMatrix(motion, turn.data());
  const Eigen::Vector3d center = node.T_model_view * node.center;
  const Eigen::Vector3d from_center = node.T_model_view.translation() - center;
  R = turn * node.T_model_view.linear().template cast<T>();
  t = turn * from_center.template cast<T>() + center.template cast<T>() +
      Eigen::Map<const Eigen::Matrix<T, 3, 1>>(motion + 3);
}

struct EdgeResidual {
  template <typename T>
  bool operator()(const T* motion_a, const T* motion_b, T* residual) const {
    Eigen::Matrix<T, 3, 3> R_a, R_b;
    Eigen::Matrix<T, 3, 1> t_a, t_b;
    poseAfter(a, motion_a, R_a, t_a);
    poseAfter(b, motion_b, R_b, t_b);
    const Eigen::Matrix<T, 3, 3> off = R_b.transpose() * R_a * edge.T_b_a.linear().transpose().template cast<T>();
    const Eigen::Vector3d in_a = edge.T_b_a.inverse() * edge.information.pivot;
    Eigen::Matrix<T, 6, 1> difference;
    ceres::RotationMatrixToAngleAxis(off.data(), difference.data());
    difference.template tail<3>() =
        R_b.transpose() * (R_a * in_a.template cast<T>() + t_a - t_b) - edge.information.pivot.template cast<T>();
    Eigen::Map<Eigen::Matrix<T, 6, 1>>(residual, 6) = root.template cast<T>() * difference;
    return true;
  }

  PoseNode a, b;
  PoseEdge edge;
  Matrix6d root;  // root^T root is the information
};

struct PlaneResidual {
  template <typename T>
  bool operator()(const T* motion, T* residual) const {
    Eigen::Matrix<T, 3, 3> R;
    Eigen::Matrix<T, 3, 1> t;
    poseAfter(node, motion, R, t);
    const Eigen::Matrix<T, 3, 1> normal = R * node.plane->normal().template cast<T>();
    const Eigen::Vector3d foot = node.plane->projection(node.center);
    residual[0] = normal[0] / T(plane_tilt);
    residual[1] = normal[1] / T(plane_tilt);
    residual[2] = (R * foot.template cast<T>() + t)[2] / T(plane_offset);
    return true;
  }

  PoseNode node;
};

/// Keeps the motion of the fixed node at nothing; where planes level the model, but for tilt and height.
struct HeldResidual {
  template <typename T>
  bool operator()(const T* motion, T* residual) const {
    for (int k = 0; k < 6; ++k) {
      const bool of_plane = k == 0 || k == 1 || k == 5;
      residual[k] = of_plane && leveled ? T(0) : motion[k] / T(held);
    }
    return true;
  }

  bool leveled;
};

/// The information as it counts: at least and at most as much as stated above.
Matrix6d rootOf(const Matrix6d& information) {
  Eigen::Matrix<double, 6, 1> common, unknown;
  common << Eigen::Vector3d::Constant(common_turn), Eigen::Vector3d::Constant(common_shift);
  unknown << Eigen::Vector3d::Constant(unknown_turn), Eigen::Vector3d::Constant(unknown_shift);
  // In units of what is unknown all directions can be compared.
  const Matrix6d scaled = unknown.asDiagonal() * information * unknown.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(scaled);
  const Eigen::Matrix<double, 6, 1> values = solver.eigenvalues().cwiseMax(1);
  Matrix6d covariance = solver.eigenvectors() * values.cwiseInverse().asDiagonal() * solver.eigenvectors().transpose();
  covariance = (unknown.asDiagonal() * covariance * unknown.asDiagonal()).eval();
  covariance += Matrix6d(common.cwiseAbs2().asDiagonal());
  const Matrix6d counted = covariance.inverse();
  return Eigen::LLT<Matrix6d>(0.5 * (counted + counted.transpose())).matrixU();
}

}  // namespace

std::vector<Eigen::Isometry3d> optimizedPoses(const std::vector<PoseNode>& nodes, const std::vector<PoseEdge>& edges,
                                              std::size_t fixed) {
  std::vector<Motion> motions(nodes.size(), Motion{});
  ceres::Problem problem;
  for (Motion& motion : motions) problem.AddParameterBlock(motion.data(), 6);
  for (const PoseEdge& edge : edges) {
    auto* residual =
        new EdgeResidual{nodes[edge.a], nodes[edge.b], edge, rootOf(edge.information.matrix)};  // the problem owns it
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<EdgeResidual, 6, 6, 6>(residual),
                             new ceres::CauchyLoss(outlier), motions[edge.a].data(), motions[edge.b].data());
  }
  bool leveled = false;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!nodes[i].plane) continue;
    leveled = true;
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<PlaneResidual, 3, 6>(new PlaneResidual{nodes[i]}),
                             new ceres::CauchyLoss(outlier), motions[i].data());
  }
  problem.AddResidualBlock(new ceres::AutoDiffCostFunction<HeldResidual, 6, 6>(new HeldResidual{leveled}), nullptr,
                           motions[fixed].data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = most_iterations;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);

  std::vector<Eigen::Isometry3d> poses;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    Eigen::Matrix3d R;
    Eigen::Vector3d t;
    poseAfter(nodes[i], motions[i].data(), R, t);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = Eigen::Quaterniond(R).normalized().toRotationMatrix();
    pose.translation() = t;
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace sks
