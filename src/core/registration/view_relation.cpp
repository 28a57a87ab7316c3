// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/view_relation.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace sks {
namespace {

// First poses come from single local reference frames, which are off by some degrees and a centimetre.
constexpr double rough_distance = 0.015, rough_angle = 0.8;                                       // [m], [rad]
constexpr double rough_color = 2;                                                                 // of the tolerance
constexpr std::size_t pair_first_points = 100, pair_rough_points = 300, pair_last_points = 1500;  // of each view
constexpr std::size_t most_first = 48, most_rough = 8;                                            // poses
constexpr double same_first_angle = 0.17, same_first_shift = 0.015;                               // 10 degrees
constexpr double same_angle = 0.052, same_shift = 0.005;                                          // 3 degrees
constexpr double enough_overlap = 0.5;     // of the smaller view: more says no more of a pose that is exact
constexpr int turns = 24;                  // about the normal of the planes that views stand on, 15 degrees apart
constexpr double largest_levelling = 0.5;  // [rad] first poses that are tilted more are wrong
constexpr double plane_turn_deviation = 0.01, plane_shift_deviation = 0.002;  // of a table's plane [rad], [m]

/// A pose and how good it looks.
struct Rated {
  Eigen::Isometry3d T_b_a;
  double rating = 0;
};

std::size_t strideFor(const CapturedView& a, const CapturedView& b, std::size_t points) {
  return std::max<std::size_t>(1, std::max(a.points.size(), b.points.size()) / points);
}

double angleOf(const Eigen::Isometry3d& motion) {
  return Eigen::AngleAxisd(motion.linear()).angle();
}

bool same(const Eigen::Isometry3d& T, const Eigen::Isometry3d& other, const Eigen::Vector3d& center, double angle,
          double shift) {
  return (T * center - other * center).norm() <= shift && angleOf(T.inverse() * other) <= angle;
}

/// The best ones that differ.
std::vector<Rated> bestOf(std::vector<Rated> poses, const Eigen::Vector3d& center, std::size_t most, double angle,
                          double shift) {
  std::stable_sort(poses.begin(), poses.end(), [](const Rated& x, const Rated& y) { return x.rating > y.rating; });
  std::vector<Rated> kept;
  for (const Rated& pose : poses) {
    if (kept.size() >= most || pose.rating <= 0) break;
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const Rated& other) {
      return same(pose.T_b_a, other.T_b_a, center, angle, shift);
    });
    if (!known) kept.push_back(pose);
  }
  return kept;
}

double ratingOf(const ViewAgreement& agreement) {
  const double seen = agreement.facing > 0 ? agreement.matched / agreement.facing : 0;
  const double overlap = std::min(enough_overlap, agreement.overlap());
  return overlap * seen * std::max(0.0, 1 - 3 * agreement.contradicted()) * agreement.color * agreement.color;
}

/// Turned and shifted by as little as lays the planes on each other; none where that is much.
std::optional<Eigen::Isometry3d> levelled(const Eigen::Isometry3d& T_b_a, const CapturedView& a,
                                          const CapturedView& b) {
  const Eigen::Vector3d up = T_b_a.linear() * a.plane->normal(), center = T_b_a * a.center;
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(up, b.plane->normal());
  if (Eigen::AngleAxisd(turn).angle() > largest_levelling) return std::nullopt;
  const double height = a.plane->signedDistance(a.center) - b.plane->signedDistance(center);
  return Eigen::Isometry3d(Eigen::Translation3d(center + height * b.plane->normal()) * turn *
                           Eigen::Translation3d(-center) * T_b_a);
}

bool planesAgree(const Eigen::Isometry3d& T_b_a, const CapturedView& a, const CapturedView& b,
                 const PairLimits& limits) {
  if (!a.plane || !b.plane) return true;
  const double cosine = (T_b_a.linear() * a.plane->normal()).dot(b.plane->normal());
  const double height = b.plane->signedDistance(T_b_a * a.center) - a.plane->signedDistance(a.center);
  return cosine >= std::cos(limits.plane_angle) && std::abs(height) <= limits.plane_height;
}

/// What two planes say of a motion: no tilt, the same height.
Matrix6d planeInformation(const Eigen::Vector3d& normal) {
  Matrix6d information = Matrix6d::Zero();
  const Eigen::Matrix3d along = normal * normal.transpose();
  information.topLeftCorner<3, 3>() =
      (Eigen::Matrix3d::Identity() - along) / (2 * plane_turn_deviation * plane_turn_deviation);
  information.bottomRightCorner<3, 3>() = along / (2 * plane_shift_deviation * plane_shift_deviation);
  return information;
}

std::vector<Eigen::Isometry3d> firstPoses(const CapturedView& a, const CapturedView& b) {
  std::vector<Eigen::Isometry3d> poses;
  const bool level = a.plane && b.plane;
  const auto add = [&](const Eigen::Isometry3d& T_b_a) {
    if (!level) {
      poses.push_back(T_b_a);
    } else if (const auto leveled = levelled(T_b_a, a, b)) {
      poses.push_back(*leveled);
    }
  };
  const auto byKeypoints = [&](std::size_t in_a, std::size_t in_b) {
    Eigen::Isometry3d T_b_a = Eigen::Isometry3d::Identity();
    const Eigen::Matrix3f rotation = b.frames[in_b].transpose() * a.frames[in_a];
    T_b_a.linear() = Eigen::Quaterniond(rotation.cast<double>()).normalized().toRotationMatrix();
    T_b_a.translation() = b.keypoints[in_b].cast<double>() - T_b_a.linear() * a.keypoints[in_a].cast<double>();
    add(T_b_a);
  };
  for (const Match& match : a.matcher->match(b.descriptors, 1)) byKeypoints(match.word, match.descriptor);
  for (const Match& match : b.matcher->match(a.descriptors, 1)) byKeypoints(match.descriptor, match.word);
  for (int turn = 0; level && turn < turns; ++turn) {
    const Eigen::Quaterniond upright = Eigen::AngleAxisd(2 * EIGEN_PI * turn / turns, b.plane->normal()) *
                                       Eigen::Quaterniond::FromTwoVectors(a.plane->normal(), b.plane->normal());
    add(Eigen::Isometry3d(Eigen::Translation3d(b.center) * upright * Eigen::Translation3d(-a.center)));
  }
  return poses;
}

/// First poses, aligned roughly.
std::vector<Rated> roughPoses(const CapturedView& a, const CapturedView& b, const VerificationSettings& rough) {
  std::vector<Rated> poses;
  const std::size_t stride = strideFor(a, b, pair_first_points);
  for (const Eigen::Isometry3d& T : firstPoses(a, b)) {
    poses.push_back({T, ratingOf(compareViews(a, b, T, rough, stride))});
  }
  poses = bestOf(std::move(poses), a.center, most_first, same_first_angle, same_first_shift);
  AlignmentRounds rounds;
  rounds.partners = Partners::along_ray;
  rounds.stride = strideFor(a, b, pair_rough_points);
  for (Rated& pose : poses) {
    pose.T_b_a = alignViews(a, b, pose.T_b_a, rounds).T_b_a;
    pose.rating = ratingOf(compareViews(a, b, pose.T_b_a, rough, rounds.stride));
  }
  return bestOf(std::move(poses), a.center, most_rough, same_angle, same_shift);
}

}  // namespace

ViewRelation relationAt(const CapturedView& a, const CapturedView& b, const Eigen::Isometry3d& T_b_a,
                        const Settings& settings, const PairLimits& limits) {
  AlignmentRounds rounds;
  rounds.count = 8;
  rounds.start_distance = rounds.end_distance;
  rounds.end_distance = 0.5 * rounds.start_distance;
  rounds.stride = strideFor(a, b, pair_last_points);
  const Alignment alignment = alignViews(a, b, T_b_a, rounds);
  ViewRelation relation;
  relation.T_b_a = alignment.T_b_a;
  if (alignment.pairs == 0) return relation;
  relation.information = alignment.information;
  if (a.plane && b.plane) relation.information.matrix += planeInformation(b.plane->normal());
  relation.deviation = alignment.deviation;
  relation.uncertainty = largestUncertainty(relation.information, std::min(a.radius, b.radius));
  relation.determined = relation.uncertainty.turn <= limits.largest_turn_deviation &&
                        relation.uncertainty.shift <= limits.largest_shift_deviation;
  relation.agreement = compareViews(a, b, relation.T_b_a, settings.verification, rounds.stride);
  const bool allowed = relation.agreement.contradicted() <= limits.most_contradicted &&
                       relation.agreement.overlap() >= limits.least_overlap &&
                       relation.agreement.color >= limits.least_color && planesAgree(relation.T_b_a, a, b, limits);
  relation.score = allowed ? ratingOf(relation.agreement) : 0;
  return relation;
}

std::vector<ViewRelation> relateViews(const CapturedView& a, const CapturedView& b, const Settings& settings,
                                      const PairLimits& limits) {
  VerificationSettings rough = settings.verification;
  rough.support_distance = std::max(rough.support_distance, rough_distance);
  rough.support_angle = std::max(rough.support_angle, rough_angle);
  rough.color_tolerance *= rough_color;
  std::vector<ViewRelation> relations;
  for (const Rated& pose : roughPoses(a, b, rough)) {
    ViewRelation relation = relationAt(a, b, pose.T_b_a, settings, limits);
    if (relation.score > 0) relations.push_back(relation);
  }
  std::stable_sort(relations.begin(), relations.end(),
                   [](const ViewRelation& x, const ViewRelation& y) { return x.score > y.score; });
  std::vector<ViewRelation> kept;
  for (const ViewRelation& relation : relations) {
    if (kept.size() >= limits.most_alternatives) break;
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const ViewRelation& other) {
      return same(relation.T_b_a, other.T_b_a, a.center, same_angle, same_shift);
    });
    if (!known) kept.push_back(relation);
  }
  return kept;
}

}  // namespace sks
