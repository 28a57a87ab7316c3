// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/scene_matching.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace sks {
namespace {

/// How far a detection puts the point whose position the ground truth states, the centre of the reference's box, from
/// there. Where its pose is not in the model frame of the ground truth, its own box centre stands for that point.
double distanceTo(const GroundTruth& truth, const Detection& detection) {
  Eigen::Vector3d position = detection.position();
  if (truth.T_scene_model && truth.model_frame == detection.view) {
    position = detection.T_scene_model * (truth.T_scene_model->inverse() * truth.position);
  }
  return (truth.position - position).norm();
}

/// Index of the instance of the detection's object that is nearest to it, of those for which `usable` holds.
template <typename Predicate>
std::optional<std::size_t> nearestGroundTruth(const Scene& scene, const Detection& detection, Predicate usable) {
  std::optional<std::size_t> nearest;
  double nearest_distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (scene.objects[i].object != detection.object || !usable(i)) continue;
    const double distance = distanceTo(scene.objects[i], detection);
    if (distance < nearest_distance) {
      nearest = i;
      nearest_distance = distance;
    }
  }
  return nearest;
}

double distanceTo(const Scene& scene, std::optional<std::size_t> ground_truth, const Detection& detection) {
  if (!ground_truth) return std::numeric_limits<double>::infinity();
  return distanceTo(scene.objects[*ground_truth], detection);
}

/// Best first, in an order that depends on the detections alone.
std::vector<Detection> ranked(const Scene& scene, const std::vector<Detection>& detections) {
  const auto key = [&](const Detection& detection) {
    const auto nearest = nearestGroundTruth(scene, detection, [](std::size_t) { return true; });
    const Eigen::Vector3d p = detection.position();
    return std::make_tuple(-detection.score, distanceTo(scene, nearest, detection), detection.object, p.x(), p.y(),
                           p.z());
  };
  std::vector<std::pair<decltype(key(detections.front())), std::size_t>> order;
  order.reserve(detections.size());
  for (std::size_t i = 0; i < detections.size(); ++i) order.emplace_back(key(detections[i]), i);
  std::sort(order.begin(), order.end());
  std::vector<Detection> result;
  result.reserve(order.size());
  for (const auto& item : order) result.push_back(detections[item.second]);
  return result;
}

/// The rotation about the axis of symmetry that comes nearest to a rotation [rad] (the twist of its swing and twist).
double nearestTurn(const Eigen::Matrix3d& rotation, const Symmetry& symmetry) {
  const Eigen::Quaterniond q(rotation);
  const double angle = 2 * std::atan2(q.vec().dot(symmetry.axis), q.w());
  if (symmetry.order == 0) return angle;
  const double step = 2 * EIGEN_PI / symmetry.order;
  return step * std::round(angle / step);
}

}  // namespace

std::vector<MatchedDetection> matchScene(const Scene& scene, const std::vector<Detection>& detections,
                                         double max_distance) {
  std::vector<bool> taken(scene.objects.size(), false);
  std::vector<MatchedDetection> matched;
  for (const Detection& detection : ranked(scene, detections)) {
    MatchedDetection result;
    result.detection = detection;
    const auto nearest = nearestGroundTruth(scene, detection, [&](std::size_t i) { return !taken[i]; });
    if (isIgnored(scene, detection.object)) {
      result.outcome = Outcome::ignored;
    } else if (nearest && distanceTo(scene, nearest, detection) <= max_distance) {
      taken[*nearest] = true;
      result.outcome = Outcome::true_positive;
      result.ground_truth = nearest;
      const GroundTruth& truth = scene.objects[*nearest];
      if (truth.T_scene_reference && !truth.reference.empty() && truth.reference == detection.view) {
        result.pose_error =
            poseError(detection.T_scene_model, *truth.T_scene_reference, truth.position, truth.symmetry);
      } else if (truth.T_scene_model && truth.model_frame == detection.view) {
        result.pose_error = poseError(detection.T_scene_model, *truth.T_scene_model, truth.position);
      }
    }
    matched.push_back(std::move(result));
  }
  return matched;
}

bool isIgnored(const Scene& scene, const std::string& object) {
  return std::find(scene.ignore.begin(), scene.ignore.end(), object) != scene.ignore.end();
}

PoseError poseError(const Eigen::Isometry3d& T_scene_found, const Eigen::Isometry3d& T_scene_reference,
                    const Eigen::Vector3d& position, const std::optional<Symmetry>& symmetry) {
  const Eigen::Vector3d center = T_scene_reference.inverse() * position;  // in the reference's frame
  Eigen::Isometry3d T_scene_true = T_scene_reference;
  if (symmetry) {
    const Eigen::Matrix3d difference = T_scene_reference.linear().transpose() * T_scene_found.linear();
    T_scene_true = T_scene_reference * Eigen::Translation3d(center) *
                   Eigen::AngleAxisd(nearestTurn(difference, *symmetry), symmetry->axis) *
                   Eigen::Translation3d(-center);
  }
  PoseError error;
  error.translation = (T_scene_found * center - position).norm();
  const Eigen::Matrix3d difference = T_scene_found.linear() * T_scene_true.linear().transpose();
  error.rotation = Eigen::AngleAxisd(difference).angle() * 180.0 / EIGEN_PI;
  error.t_diff = (T_scene_found.matrix() - T_scene_true.matrix()).norm();
  return error;
}

}  // namespace sks
