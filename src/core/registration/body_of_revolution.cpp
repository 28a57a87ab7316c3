// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/body_of_revolution.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <Eigen/Eigenvalues>

namespace sks {
namespace {

constexpr std::size_t fewest_views = 6;       // a mug hides its handle from 120 degrees: four views 30 degrees apart
constexpr int compared_turns = 12;            // of each pair, 30 degrees apart
constexpr std::size_t revolved_points = 600;  // of a view, that are compared
constexpr int axis_rounds = 10;
constexpr double axis_scale = 0.02;       // [m] normals that miss the axis by more do not count
constexpr double horizontal_part = 0.5;   // least, of a normal that tells where the axis is
constexpr double least_spread = 0.05;     // of the directions of normals: smallest over largest eigenvalue
constexpr double golden_turn = 2.399963;  // [rad] spreads any number of turns evenly

/// Turned about z through the origin so that the camera is seen at an azimuth.
Eigen::Isometry3d seenFrom(const CapturedView& view, const Eigen::Isometry3d& T_axis_view, double azimuth) {
  const Eigen::Vector3d camera = T_axis_view * view.surface.sensor_origin.cast<double>();
  return Eigen::Isometry3d(Eigen::AngleAxisd(azimuth - std::atan2(camera.y(), camera.x()), Eigen::Vector3d::UnitZ())) *
         T_axis_view;
}

bool sameInAllTurns(const CapturedView& a, const Eigen::Isometry3d& T_axis_a, const CapturedView& b,
                    const Eigen::Isometry3d& T_axis_b, const Settings& settings, const PairLimits& limits) {
  const std::size_t stride = std::max<std::size_t>(1, std::max(a.points.size(), b.points.size()) / revolved_points);
  for (int turn = 0; turn < compared_turns; ++turn) {
    const Eigen::AngleAxisd turned(2 * EIGEN_PI * turn / compared_turns, Eigen::Vector3d::UnitZ());
    const ViewAgreement agreement =
        compareViews(a, b, T_axis_b.inverse() * (turned * T_axis_a), settings.verification, stride);
    if (agreement.contradicted() > limits.most_contradicted) return false;
    if (agreement.overlap() >= limits.least_overlap && agreement.color < limits.least_color) return false;
  }
  return true;
}

}  // namespace

std::optional<Eigen::Vector2d> revolutionAxis(const CapturedView& view, const Eigen::Isometry3d& T_upright_view) {
  Eigen::Vector2d axis = (T_upright_view * view.center).head<2>();
  for (int round = 0; round < axis_rounds; ++round) {
    Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
    Eigen::Vector2d b = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < view.points.size(); ++i) {
      const Eigen::Vector2d n = (T_upright_view.linear() * view.normals[i].cast<double>()).head<2>();
      if (n.norm() < horizontal_part) continue;
      const Eigen::Vector2d p = (T_upright_view * view.points.point(i).cast<double>()).head<2>();
      const Eigen::Vector2d across = Eigen::Vector2d(-n.y(), n.x()).normalized();
      const double miss = across.dot(p - axis) / axis_scale;
      if (round > 0 && std::abs(miss) >= 1) continue;  // the first round finds where about the axis is
      const double weight = round > 0 ? (1 - miss * miss) * (1 - miss * miss) : 1;
      A += weight * across * across.transpose();
      b += weight * across.dot(p) * across;
    }
    const Eigen::Vector2d spread = A.selfadjointView<Eigen::Lower>().eigenvalues();
    if (!(spread[0] > least_spread * spread[1])) return std::nullopt;
    axis = A.ldlt().solve(b);
  }
  return axis;
}

std::optional<ViewPoses> posesOfRevolution(const std::vector<CapturedView>& views,
                                           const std::vector<Eigen::Isometry3d>& upright, const Settings& settings,
                                           const PairLimits& limits, int threads) {
  if (views.size() < fewest_views) return std::nullopt;
  ViewPoses poses(views.size());
  for (std::size_t v = 0; v < views.size(); ++v) {
    const std::optional<Eigen::Vector2d> axis = revolutionAxis(views[v], upright[v]);
    if (!axis) return std::nullopt;
    const Eigen::Isometry3d T_axis_view = Eigen::Translation3d(-axis->x(), -axis->y(), 0) * upright[v];
    poses[v] = seenFrom(views[v], T_axis_view, double(v) * golden_turn);
  }
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t a = 0; a < views.size(); ++a) {
    for (std::size_t b = a + 1; b < views.size(); ++b) pairs.emplace_back(a, b);
  }
  std::vector<char> same(pairs.size(), 0);
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const auto [a, b] = pairs[p];
    same[p] = sameInAllTurns(views[a], *poses[a], views[b], *poses[b], settings, limits);
  }
  if (std::find(same.begin(), same.end(), 0) != same.end()) return std::nullopt;
  return poses;
}

}  // namespace sks
