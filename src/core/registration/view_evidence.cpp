// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/view_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/verification/pose_evidence.hpp"

namespace sks {
namespace {

constexpr double patch = 0.007;               // [m] errors nearer to each other than this are alike
constexpr float depth_deviation = 0.0015f;    // [m]
constexpr float farthest_deviation = 3;       // standard deviations from which on all is equally wrong
constexpr float depthless = 0.25f;            // lightness below which a surface may give no depth at all
constexpr float print_deviation = 0.25f;      // of each axis of printsOf()
constexpr float outlier_share = 0.05f;        // of prints
constexpr float largest_common_shift = 0.5f;  // white balance
constexpr double most_for = 0.4;              // what a patch's print says for a pose at most
constexpr std::size_t least_prints = 10;
constexpr std::size_t evidence_points = 250;  // of each view

/// A matched point.
struct PrintPair {
  Eigen::Vector3f own, seen;
  bool from_a;
};

struct Sums {
  double matched = 0, shape = 0, against = 0;
};

void collect(const CapturedView& from, const CapturedView& into, const Eigen::Isometry3f& T, bool from_a,
             const VerificationSettings& settings, std::size_t stride, Sums& sums, std::vector<PrintPair>& prints) {
  const float distance = float(settings.support_distance), agreement = float(std::cos(settings.support_angle));
  const bool printed = !from.prints.empty() && !into.prints.empty();
  for (std::size_t i = 0; i < from.points.size(); i += stride) {
    const Eigen::Vector3f p = T * from.points.point(i), n = T.linear() * from.normals[i];
    const Sighting seen = into.image.look(p, distance);
    if (seen.sight == Sight::in_front) sums.against += 1;
    if (seen.sight == Sight::unknown) {
      const bool may_be_lost = from.hasColor() && from.colors[i][0] < depthless;
      if (!may_be_lost && into.silhouette.isOutside(p, distance)) sums.against += 1;
    }
    if (seen.sight != Sight::at || !seen.hasPoint()) continue;
    const Eigen::Vector3f ray = into.surface.sensor_origin - p, apart = seen.cell->position() - p;
    if (n.dot(ray) <= grazing * ray.norm() || n.dot(seen.cell->normal()) <= agreement) continue;
    if (apart.squaredNorm() > distance * distance) continue;
    const float residual = std::min(farthest_deviation, std::abs(seen.cell->normal().dot(apart)) / depth_deviation);
    sums.matched += 1;
    sums.shape += 0.5 * double(1 - residual * residual);
    if (printed) prints.push_back({from.prints[from.surface_point[i]], into.prints[into.image.pointOf(seen)], from_a});
  }
}

/// By which the white balance makes the hues of b differ from those of a.
Eigen::Vector3f printShift(const std::vector<PrintPair>& prints) {
  Eigen::Vector3f shift = Eigen::Vector3f::Zero();
  std::vector<float> values(prints.size());
  for (int axis = 1; axis < 3; ++axis) {
    for (std::size_t k = 0; k < prints.size(); ++k) {
      const float difference = prints[k].seen[axis] - prints[k].own[axis];
      values[k] = prints[k].from_a ? difference : -difference;
    }
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    shift[axis] = std::clamp(*middle, -largest_common_shift, largest_common_shift);
  }
  return shift;
}

/// Calls `f(log_likelihood)` for each pair.
template <typename Function>
void forEachLikelihood(const std::vector<PrintPair>& prints, Function&& f) {
  if (prints.size() < least_prints) return;
  const Eigen::Vector3f shift = printShift(prints);
  for (const PrintPair& pair : prints) {
    const Eigen::Vector3f difference = pair.seen - pair.own - (pair.from_a ? 1.0f : -1.0f) * shift;
    const float same = std::exp(-0.5f * difference.squaredNorm() / (print_deviation * print_deviation));
    f(double(std::log((1 - outlier_share) * same + outlier_share)));
  }
}

/// Of all points as many are compared in every pose.
std::size_t comparedStride(const CapturedView& a, const CapturedView& b) {
  return std::max<std::size_t>(1, std::max(a.points.size(), b.points.size()) / evidence_points);
}

/// Matches of both views. They keep their memory from pose to pose.
const std::vector<PrintPair>& matchedPrints(const CapturedView& a, const CapturedView& b,
                                            const Eigen::Isometry3d& T_b_a, const VerificationSettings& settings,
                                            Sums& sums) {
  thread_local std::vector<PrintPair> prints;
  prints.clear();
  const std::size_t stride = comparedStride(a, b);
  collect(a, b, T_b_a.cast<float>(), true, settings, stride, sums, prints);
  collect(b, a, T_b_a.inverse().cast<float>(), false, settings, stride, sums, prints);
  return prints;
}

}  // namespace

ViewEvidence ViewComparison::at(const Eigen::Isometry3d& T_b_a, const UsualPrints& usual) const {
  Sums sums;
  const std::vector<PrintPair>& prints = matchedPrints(a_, b_, T_b_a, settings_, sums);
  const double stride = double(comparedStride(a_, b_));
  // each patch is looked for twice where both saw it
  const double share = 0.5 * stride * std::min(1.0, double(a_.spacing) * double(a_.spacing) / (patch * patch));
  const double least = double(std::min(a_.points.size(), b_.points.size())) / stride;
  ViewEvidence evidence;
  evidence.matched = share * sums.matched;
  evidence.shape = share * sums.shape;
  evidence.against = share * sums.against;
  evidence.overlap = least > 0 ? 0.5 * sums.matched / least : 0;
  forEachLikelihood(
      prints, [&](double likelihood) { evidence.color += share * std::min(most_for, likelihood - usual.mean()); });
  return evidence;
}

void ViewComparison::learn(const Eigen::Isometry3d& T_b_a, UsualPrints& usual) const {
  Sums sums;
  forEachLikelihood(matchedPrints(a_, b_, T_b_a, settings_, sums), [&](double likelihood) { usual.add(likelihood); });
}

}  // namespace sks
