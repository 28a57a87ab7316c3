// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/view_alignment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Eigenvalues>

#include "core/verification/point_to_plane.hpp"

namespace sks {
namespace {

constexpr double beside = 2;                // spacings: partners farther aside lie beyond the edge of a view
constexpr double correlation = 0.007;       // [m] depth errors nearer to each other than this are no two measurements
constexpr double least_deviation = 0.0005;  // [m] no sensor measures a surface better
constexpr double unknown_deviation = 10;    // [m or rad] of what the data say nothing about

/// A point of a, mapped into b, and its partner; each with its own normal there.
struct ViewPair {
  Eigen::Vector3d a, b, normal_a, normal_b;
  bool from_a;  // b's plane is compared with, else a's
};

/// A point of a view.
struct Partner {
  Eigen::Vector3f point, normal;
};

/// The nearest point, if its normal agrees and it does not lie beside.
std::optional<Partner> nearestPartner(const CapturedView& view, const Eigen::Vector3f& p, const Eigen::Vector3f& n,
                                      float distance, std::vector<PointGrid::Run>& runs) {
  float nearest = std::numeric_limits<float>::infinity();
  std::size_t found = view.points.size();
  view.points.forEachNeighbor(p, distance, runs, [&](std::uint32_t j, float squared) {
    if (squared < nearest) {
      nearest = squared;
      found = j;
    }
  });
  if (found == view.points.size()) return std::nullopt;
  const Partner partner{view.points.point(found), view.normals[found]};
  const Eigen::Vector3f apart = partner.point - p;
  const float aside = (apart - partner.normal.dot(apart) * partner.normal).norm();
  if (n.dot(partner.normal) <= normal_agreement || aside > std::max(float(beside) * view.spacing, 0.5f * distance)) {
    return std::nullopt;
  }
  return partner;
}

/// What the camera of the view saw in the direction of a position.
std::optional<Partner> seenPartner(const CapturedView& view, const Eigen::Vector3f& p, const Eigen::Vector3f& n,
                                   float distance) {
  const Sighting seen = view.image.look(p, distance);
  if (!seen.hasPoint() || n.dot(seen.cell->normal()) <= normal_agreement ||
      (seen.cell->position() - p).squaredNorm() > distance * distance) {
    return std::nullopt;
  }
  return Partner{seen.cell->position(), seen.cell->normal()};
}

/// Partners in `to` for the points of `from`. @param T pose of `from` in the frame of `to`
template <typename Function>
void forEachPartner(const CapturedView& from, const CapturedView& to, const Eigen::Isometry3f& T, float distance,
                    const AlignmentRounds& rounds, std::vector<PointGrid::Run>& runs, Function&& f) {
  for (std::size_t i = 0; i < from.points.size(); i += rounds.stride) {
    const Eigen::Vector3f p = T * from.points.point(i), n = T.linear() * from.normals[i];
    if (n.dot(to.surface.sensor_origin - p) <= 0) continue;
    const std::optional<Partner> partner = rounds.partners == Partners::nearest
                                               ? nearestPartner(to, p, n, distance, runs)
                                               : seenPartner(to, p, n, distance);
    if (partner) f(i, *partner);
  }
}

void pairViews(const CapturedView& a, const CapturedView& b, const Eigen::Isometry3d& T_b_a, float distance,
               const AlignmentRounds& rounds, std::vector<PointGrid::Run>& runs, std::vector<ViewPair>& pairs) {
  pairs.clear();
  const Eigen::Isometry3f T = T_b_a.cast<float>(), T_a_b = T_b_a.inverse().cast<float>();
  forEachPartner(a, b, T, distance, rounds, runs, [&](std::size_t i, const Partner& in_b) {
    pairs.push_back({(T * a.points.point(i)).cast<double>(), in_b.point.cast<double>(),
                     (T.linear() * a.normals[i]).cast<double>(), in_b.normal.cast<double>(), true});
  });
  forEachPartner(b, a, T_a_b, distance, rounds, runs, [&](std::size_t i, const Partner& in_a) {
    pairs.push_back({(T * in_a.point).cast<double>(), b.points.point(i).cast<double>(),
                     (T.linear() * in_a.normal).cast<double>(), b.normals[i].cast<double>(), false});
  });
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
    pairViews(a, b, result.T_b_a, float(distance), rounds, runs, pairs);
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
