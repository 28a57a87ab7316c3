// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/view_alignment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Eigenvalues>

#include "core/verification/point_to_plane.hpp"

namespace sks {
namespace {

constexpr double beside = 2;               // spacings: partners farther aside lie beyond the edge of a view
constexpr double correlation = 0.005;      // [m] depth errors nearer to each other than this are no two measurements
constexpr double least_deviation = 0.0005;  // [m] no sensor measures a surface better
constexpr double unknown_deviation = 10;   // [m or rad] of what the data say nothing about

/// A point of a, mapped into b, and its partner; each with its own normal there.
struct ViewPair {
  Eigen::Vector3d a, b, normal_a, normal_b;
  bool from_a;  // b's plane is compared with, else a's
};

/// Partner of a position with a normal: the nearest point, if its normal agrees and it does not lie beside.
std::size_t viewPartner(const CapturedView& view, const Eigen::Vector3f& p, const Eigen::Vector3f& n, float distance,
                      std::vector<PointGrid::Run>& runs) {
  float nearest = std::numeric_limits<float>::infinity();
  std::size_t partner = view.points.size();
  view.points.forEachNeighbor(p, distance, runs, [&](std::uint32_t j, float squared) {
    if (squared < nearest) {
      nearest = squared;
      partner = j;
    }
  });
  if (partner == view.points.size()) return partner;
  const Eigen::Vector3f apart = view.points.point(partner) - p, normal = view.normals[partner];
  const float aside = (apart - normal.dot(apart) * normal).norm();
  const bool agrees = n.dot(normal) > normal_agreement && aside <= std::max(float(beside) * view.spacing, 0.5f * distance);
  return agrees ? partner : view.points.size();
}

void pairViews(const CapturedView& a, const CapturedView& b, const Eigen::Isometry3d& T_b_a, float distance,
               std::size_t stride, std::vector<PointGrid::Run>& runs, std::vector<ViewPair>& pairs) {
  pairs.clear();
  const Eigen::Isometry3f T = T_b_a.cast<float>(), T_a_b = T_b_a.inverse().cast<float>();
  for (std::size_t i = 0; i < a.points.size(); i += stride) {
    const Eigen::Vector3f p = T * a.points.point(i), n = T.linear() * a.normals[i];
    if (n.dot(b.surface.sensor_origin - p) <= 0) continue;
    const std::size_t j = viewPartner(b, p, n, distance, runs);
    if (j == b.points.size()) continue;
    pairs.push_back({p.cast<double>(), b.points.point(j).cast<double>(), n.cast<double>(),
                     b.normals[j].cast<double>(), true});
  }
  for (std::size_t i = 0; i < b.points.size(); i += stride) {
    const Eigen::Vector3f p = T_a_b * b.points.point(i), n = T_a_b.linear() * b.normals[i];
    if (n.dot(a.surface.sensor_origin - p) <= 0) continue;
    const std::size_t j = viewPartner(a, p, n, distance, runs);
    if (j == a.points.size()) continue;
    pairs.push_back({(T * a.points.point(j)).cast<double>(), b.points.point(i).cast<double>(),
                     (T.linear() * a.normals[j]).cast<double>(), b.normals[i].cast<double>(), false});
  }
}

double pairResidual(const ViewPair& pair) {
  return (pair.from_a ? pair.normal_b : pair.normal_a).dot(pair.b - pair.a);
}

/// Robust standard deviation of the residuals.
double pairDeviation(const std::vector<ViewPair>& pairs) {
  std::vector<double> sizes;
  for (const ViewPair& pair : pairs) sizes.push_back(std::abs(pairResidual(pair)));
  std::nth_element(sizes.begin(), sizes.begin() + std::ptrdiff_t(sizes.size() / 2), sizes.end());
  return std::max(least_deviation, 1.4826 * sizes[sizes.size() / 2]);
}

Matrix6d pairInformation(const std::vector<ViewPair>& pairs, const Eigen::Vector3d& pivot, double deviation,
                       double measurements_per_pair) {
  Matrix6d sum = Matrix6d::Zero();
  for (const ViewPair& pair : pairs) {
    if (std::abs(pairResidual(pair)) > 3 * deviation) continue;
    Eigen::Matrix<double, 6, 1> row_a, row_b;
    row_a << (pair.a - pivot).cross(pair.normal_a), pair.normal_a;
    row_b << (pair.b - pivot).cross(pair.normal_b), pair.normal_b;
    sum += row_a * row_b.transpose();
  }
  return 0.5 * measurements_per_pair / (deviation * deviation) * (sum + sum.transpose());
}

}  // namespace

Uncertainty largestUncertainty(const MotionInformation& information, double radius) {
  Eigen::Matrix<double, 6, 1> scale;
  scale << Eigen::Vector3d::Constant(1 / radius), Eigen::Vector3d::Ones();
  const Matrix6d scaled = scale.asDiagonal() * information.matrix * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(scaled);
  Uncertainty largest;
  for (int k = 0; k < 6; ++k) {
    const double value = solver.eigenvalues()[k];
    const double deviation = value > 0 ? std::min(unknown_deviation, 1 / std::sqrt(value)) : unknown_deviation;
    const Eigen::Matrix<double, 6, 1> motion = deviation * solver.eigenvectors().col(k);
    largest.turn = std::max(largest.turn, motion.head<3>().norm() / radius);
    largest.shift = std::max(largest.shift, motion.tail<3>().norm());
  }
  return largest;
}

Alignment alignViews(const CapturedView& a, const CapturedView& b, const Eigen::Isometry3d& T_b_a,
                     const AlignmentRounds& rounds) {
  thread_local std::vector<PointGrid::Run> runs;  // these keep their memory from pose to pose
  thread_local std::vector<ViewPair> pairs;
  Alignment result;
  result.T_b_a = T_b_a;
  for (int round = 0; round <= rounds.count; ++round) {  // the last one only looks
    const double progress = std::min(1.0, double(round) / std::max(1, rounds.count - 1));
    const double distance = rounds.start_distance * std::pow(rounds.end_distance / rounds.start_distance, progress);
    pairViews(a, b, result.T_b_a, float(distance), rounds.stride, runs, pairs);
    result.pairs = pairs.size();
    if (pairs.size() < fewest_pairs) {
      result.pairs = 0;
      return result;
    }
    Eigen::Vector3d pivot = Eigen::Vector3d::Zero();
    for (const ViewPair& pair : pairs) pivot += pair.a / double(pairs.size());
    if (round == rounds.count) {
      result.deviation = pairDeviation(pairs);
      const double edge = double(a.spacing) * std::sqrt(double(rounds.stride));
      const double share = 0.5 * std::min(1.0, edge * edge / (correlation * correlation));  // each pair is found twice
      result.information = {pairInformation(pairs, pivot, result.deviation, share), pivot};
      return result;
    }
    PointToPlane system(pivot);
    for (const ViewPair& pair : pairs) {
      system.add(pair.a, pair.b, pair.from_a ? pair.normal_b : pair.normal_a, distance);
    }
    result.T_b_a = system.motion() * result.T_b_a;
  }
  return result;
}

}  // namespace sks
