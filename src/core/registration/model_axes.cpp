// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/model_axes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/registration/pose_graph.hpp"
#include "core/registration/view_cluster.hpp"

namespace sks {
namespace {

/// The middle of the box of what a view shows, along the axes that the view alone would give a model; in its own
/// frame [m].
Eigen::Vector3d middleOf(const CapturedView& view) {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  if (view.plane) {
    const Eigen::Vector3d up = view.plane->normal();
    axes.col(2) = up;
    axes.col(1) = up.cross(view.surface.sensor_origin.cast<double>() - view.center).normalized();
    axes.col(0) = axes.col(1).cross(up);
  }
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < view.surface.size(); ++i) {
    box.extend(axes.transpose() * view.surface.point(i).cast<double>());
  }
  return axes * box.center();
}

/// Of the direction from what a view shows to its camera, in the plane z = 0 [rad].
double headingOf(const CapturedView& view, const Eigen::Isometry3d& T_model_view) {
  const Eigen::Vector3d direction = T_model_view.linear() * (view.surface.sensor_origin.cast<double>() - view.center);
  return std::atan2(direction.y(), direction.x());
}

/// Moves all so that a view gets a pose, or where its plane is known the turn of that about z. Without a pose: x points
/// to where the view was taken from, or else the model has the frame of the view.
void orientBy(const std::vector<CapturedView>& views, ViewPoses& poses, std::size_t by,
              const std::optional<Eigen::Isometry3d>& T_model_view = std::nullopt) {
  const Eigen::Isometry3d T_old_view = *poses[by];
  Eigen::Isometry3d T_new_old = T_model_view.value_or(Eigen::Isometry3d::Identity()) * T_old_view.inverse();
  if (views[by].plane) {  // z stays
    const double heading = T_model_view ? headingOf(views[by], *T_model_view) : 0;
    T_new_old = Eigen::AngleAxisd(heading - headingOf(views[by], T_old_view), Eigen::Vector3d::UnitZ());
  }
  for (auto& pose : poses) {
    if (pose) pose = T_new_old * *pose;
  }
}

}  // namespace

std::size_t firstTied(const ViewPoses& poses) {
  return std::size_t(std::find_if(poses.begin(), poses.end(), [](const auto& pose) { return bool(pose); }) -
                     poses.begin());
}

ModelAxes orientModel(const std::vector<CapturedView>& views, ViewPoses& poses, const TiedBefore& earlier) {
  std::optional<std::size_t> first;
  for (std::size_t count = fewest_edges + 1; count < views.size(); ++count) {
    const ViewPoses& before = earlier(count);
    if (firstTied(before) == before.size()) continue;
    if (!first) first = firstTied(before);
    if (poses[*first]) break;
    if (!before[*first]) continue;
    ViewPoses oriented = before;
    orientBy(views, oriented, *first);
    for (std::size_t v = 0; v < count; ++v) {
      if (!oriented[v] || !poses[v]) continue;
      orientBy(views, poses, v, oriented[v]);
      return {v, *poses[v] * oriented[v]->inverse() * *oriented[*first] * middleOf(views[*first])};
    }
  }
  if (!first || !poses[*first]) first = firstTied(poses);
  orientBy(views, poses, *first);
  return {*first, *poses[*first] * middleOf(views[*first])};
}

}  // namespace sks
