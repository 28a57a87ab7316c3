// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/upright_alignment.hpp"

#include <algorithm>
#include <cmath>

#include "core/verification/point_to_plane.hpp"

namespace sks {
namespace {

constexpr double least_information = 1e-9;  // of the largest: along motions that nothing is known of

/// Normal equations of a turn about the vertical through a pivot and a shift in the plane.
class UprightEquations {
public:
  explicit UprightEquations(const Eigen::Vector3d& pivot) : pivot_(pivot) {}

  /// @param point that moves @param onto a point of the plane that it is to reach @param normal of the plane
  void add(const Eigen::Vector3d& point, const Eigen::Vector3d& onto, const Eigen::Vector3d& normal, double scale) {
    const double residual = normal.dot(onto - point), share = residual / scale;
    if (std::abs(share) >= 1) return;
    const double weight = (1 - share * share) * (1 - share * share);  // Tukey
    const Eigen::Vector3d arm = point - pivot_;
    const Eigen::Vector3d row(arm.x() * normal.y() - arm.y() * normal.x(), normal.x(), normal.y());
    A_ += weight * row * row.transpose();
    b_ += weight * residual * row;
    ++pairs_;
  }

  std::size_t pairs() const { return pairs_; }

  Eigen::Isometry3d motion() const {
    const Eigen::Matrix3d damped = A_ + least_information * A_.trace() * Eigen::Matrix3d::Identity();
    const Eigen::Vector3d m = damped.ldlt().solve(b_);
    return Eigen::Isometry3d(Eigen::Translation3d(pivot_ + Eigen::Vector3d(m[1], m[2], 0)) *
                             Eigen::AngleAxisd(m[0], Eigen::Vector3d::UnitZ()) * Eigen::Translation3d(-pivot_));
  }

private:
  Eigen::Vector3d pivot_;
  Eigen::Matrix3d A_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b_ = Eigen::Vector3d::Zero();
  std::size_t pairs_ = 0;
};

/// Calls `f(p, q, n)`, all in the model, for points p of `from` and what the camera of `into` saw in their direction.
template <typename Function>
void forEachUprightPair(const CapturedView& from, const Eigen::Isometry3d& T_model_from, const CapturedView& into,
                        const Eigen::Isometry3d& T_model_into, double distance, std::size_t points, Function&& f) {
  const Eigen::Isometry3f T = (T_model_into.inverse() * T_model_from).cast<float>();
  const std::size_t stride = std::max<std::size_t>(1, from.points.size() / points);
  for (std::size_t i = 0; i < from.points.size(); i += stride) {
    const Eigen::Vector3f p = T * from.points.point(i), n = T.linear() * from.normals[i];
    if (n.dot(into.surface.sensor_origin - p) <= 0) continue;
    const Sighting seen = into.image.look(p, float(distance));
    if (!seen.hasPoint() || n.dot(seen.cell->normal()) <= normal_agreement ||
        (seen.cell->position() - p).squaredNorm() > float(distance * distance))
      continue;
    f(T_model_into * p.cast<double>(), T_model_into * seen.cell->position().cast<double>(),
      T_model_into.linear() * seen.cell->normal().cast<double>());
  }
}

}  // namespace

Eigen::Isometry3d alignedUpright(const std::vector<CapturedView>& views, const ViewPoses& poses, std::size_t view,
                                 const Eigen::Isometry3d& T_model_view, const UprightRounds& rounds) {
  Eigen::Isometry3d T = T_model_view;
  for (int round = 0; round < rounds.count; ++round) {
    const double progress = double(round) / std::max(1, rounds.count - 1);
    const double distance = rounds.start_distance * std::pow(rounds.end_distance / rounds.start_distance, progress);
    UprightEquations equations(T * views[view].center);
    for (std::size_t t = 0; t < views.size(); ++t) {
      if (!poses[t] || t == view) continue;
      forEachUprightPair(views[view], T, views[t], *poses[t], distance, rounds.points,
                         [&](const auto& p, const auto& q, const auto& n) { equations.add(p, q, n, distance); });
      forEachUprightPair(views[t], *poses[t], views[view], T, distance, rounds.points,
                         [&](const auto& p, const auto& q, const auto& n) { equations.add(q, p, n, distance); });
    }
    if (equations.pairs() < fewest_pairs) return T;
    T = equations.motion() * T;
  }
  return T;
}

}  // namespace sks
