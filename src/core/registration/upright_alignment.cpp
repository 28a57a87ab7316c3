// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/upright_alignment.hpp"

#include <algorithm>
#include <cmath>

#include "core/verification/point_to_plane.hpp"

namespace sks {
namespace {

constexpr double least_information = 1e-9;  // of the largest: along motions that nothing is known of
constexpr float outline_margin = 0.003f;    // [m] outlines are not known better
constexpr double outline_scale = 0.06;      // [m] what lies farther beside is no part of both

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

  Eigen::Isometry3d motion(bool holds_turn) const {
    const Eigen::Matrix3d damped = A_ + least_information * A_.trace() * Eigen::Matrix3d::Identity();
    Eigen::Vector3d m = Eigen::Vector3d::Zero();
    if (holds_turn) {
      m.tail<2>() = damped.bottomRightCorner<2, 2>().ldlt().solve(b_.tail<2>());
    } else {
      m = damped.ldlt().solve(b_);
    }
    return Eigen::Isometry3d(Eigen::Translation3d(pivot_ + Eigen::Vector3d(m[1], m[2], 0)) *
                             Eigen::AngleAxisd(m[0], Eigen::Vector3d::UnitZ()) * Eigen::Translation3d(-pivot_));
  }

private:
  Eigen::Vector3d pivot_;
  Eigen::Matrix3d A_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b_ = Eigen::Vector3d::Zero();
  std::size_t pairs_ = 0;
};

/// Calls `f(p, q, n, scale)`, all in the model, for points p of `from` and what the camera of `into` saw in their
/// direction; where it looked past the object, or through the point, for the way to what it saw of the object.
template <typename Function>
void forEachUprightPair(const CapturedView& from, const Eigen::Isometry3d& T_model_from, const CapturedView& into,
                        const Eigen::Isometry3d& T_model_into, double distance, std::size_t points, bool only_outlines,
                        Function&& f) {
  const Eigen::Isometry3f T = (T_model_into.inverse() * T_model_from).cast<float>();
  const std::size_t stride = std::max<std::size_t>(1, from.points.size() / points);
  for (std::size_t i = 0; i < from.points.size(); i += stride) {
    const Eigen::Vector3f p = T * from.points.point(i), n = T.linear() * from.normals[i];
    const Sighting seen = into.image.look(p, float(distance));
    if (seen.sight == Sight::unknown) {
      const Eigen::Vector3f way = into.silhouette.wayInside(p);
      if (way.norm() <= outline_margin) continue;
      f(T_model_into * p.cast<double>(), T_model_into * (p + way).cast<double>(),
        T_model_into.linear() * way.normalized().cast<double>(), outline_scale);
    }
    if (seen.sight == Sight::in_front && seen.hasPoint()) {
      const Eigen::Vector3f ray = (p - into.surface.sensor_origin).normalized();
      const float way = ray.dot(seen.cell->position() - p);
      f(T_model_into * p.cast<double>(), T_model_into * (p + way * ray).cast<double>(),
        T_model_into.linear() * ray.cast<double>(), outline_scale);
    }
    if (only_outlines || n.dot(into.surface.sensor_origin - p) <= 0) continue;
    if (!seen.hasPoint() || n.dot(seen.cell->normal()) <= normal_agreement ||
        (seen.cell->position() - p).squaredNorm() > float(distance * distance))
      continue;
    f(T_model_into * p.cast<double>(), T_model_into * seen.cell->position().cast<double>(),
      T_model_into.linear() * seen.cell->normal().cast<double>(), distance);
  }
}

}  // namespace

Eigen::Isometry3d alignedMotion(const std::vector<CapturedView>& views, const ViewPoses& poses,
                                const std::vector<std::size_t>& moved, const std::vector<std::size_t>& fixed,
                                const Eigen::Isometry3d& motion, const UprightRounds& rounds) {
  Eigen::Isometry3d M = motion;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const std::size_t v : moved) middle += *poses[v] * views[v].center / double(moved.size());
  for (int round = -rounds.outlines; round < rounds.count; ++round) {
    const double progress = std::max(0.0, double(round) / std::max(1, rounds.count - 1));
    const double distance = rounds.start_distance * std::pow(rounds.end_distance / rounds.start_distance, progress);
    UprightEquations equations(M * middle);
    for (const std::size_t v : moved) {
      for (const std::size_t t : fixed) {
        if (t == v) continue;
        const Eigen::Isometry3d T = M * *poses[v];
        forEachUprightPair(
            views[v], T, views[t], *poses[t], distance, rounds.points, round < 0,
            [&](const auto& p, const auto& q, const auto& n, double scale) { equations.add(p, q, n, scale); });
        forEachUprightPair(
            views[t], *poses[t], views[v], T, distance, rounds.points, round < 0,
            [&](const auto& p, const auto& q, const auto& n, double scale) { equations.add(q, p, n, scale); });
      }
    }
    if (equations.pairs() < fewest_pairs) {
      if (round < 0) continue;
      return M;
    }
    M = equations.motion(rounds.holds_turn) * M;
  }
  return M;
}

Eigen::Isometry3d alignedUpright(const std::vector<CapturedView>& views, const ViewPoses& poses, std::size_t view,
                                 const Eigen::Isometry3d& T_model_view, const UprightRounds& rounds) {
  ViewPoses with_view = poses;
  with_view[view] = T_model_view;
  std::vector<std::size_t> fixed;
  for (std::size_t t = 0; t < poses.size(); ++t) {
    if (poses[t] && t != view) fixed.push_back(t);
  }
  return alignedMotion(views, with_view, {view}, fixed, Eigen::Isometry3d::Identity(), rounds) * T_model_view;
}

}  // namespace sks
