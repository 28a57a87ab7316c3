// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/view_agreement.hpp"

#include <algorithm>
#include <cmath>

#include "core/verification/color_agreement.hpp"
#include "core/verification/pose_evidence.hpp"

namespace sks {
namespace {

/// Looks for the points of one view in what another camera saw.
void lookFor(const CapturedView& from, const CapturedView& into, const Eigen::Isometry3f& T,
             const VerificationSettings& settings, std::size_t stride, ViewAgreement& sum) {
  const float distance = float(settings.support_distance), agreement = float(std::cos(settings.support_angle));
  const bool colored = from.hasColor() && into.surface.hasColor() && settings.color_tolerance > 0;
  for (std::size_t i = 0; i < from.points.size(); i += stride) {
    const Eigen::Vector3f p = T * from.points.point(i), n = T.linear() * from.normals[i];
    const Eigen::Vector3f ray = into.surface.sensor_origin - p;
    sum.points += 1;
    const Sighting seen = into.image.look(p, distance);
    if (seen.sight == Sight::in_front) sum.in_front += 1;
    if (seen.sight == Sight::unknown && into.silhouette.isOutside(p, distance)) sum.outside += 1;
    if (n.dot(ray) <= grazing * ray.norm()) continue;
    if (seen.sight != Sight::occluded) sum.facing += 1;
    const bool matched = seen.hasPoint() && n.dot(seen.cell->normal()) > agreement &&
                         (seen.cell->position() - p).squaredNorm() <= distance * distance;
    if (!matched) continue;
    sum.matched += 1;
    if (!colored) continue;
    const float difference =
        squaredColorDifference(from.colors[i], into.surface.colorAt(into.image.pointOf(seen)));
    sum.color += double(colorAgreement(difference, float(settings.color_tolerance)));
  }
  sum.colored = colored;
}

}  // namespace

ViewAgreement compareViews(const CapturedView& a, const CapturedView& b, const Eigen::Isometry3d& T_b_a,
                           const VerificationSettings& settings, std::size_t stride) {
  ViewAgreement sum;
  lookFor(a, b, T_b_a.cast<float>(), settings, stride, sum);
  lookFor(b, a, T_b_a.inverse().cast<float>(), settings, stride, sum);
  sum.least = double(std::min(a.points.size(), b.points.size())) / double(stride);
  return sum;
}

}  // namespace sks
