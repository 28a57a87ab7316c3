// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/view_agreement.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "core/verification/pose_evidence.hpp"

namespace sks {
namespace {

constexpr float dark = 0.25f;             // lightness below which a surface may give no depth at all, and has no hue
constexpr float middle_lightness = 0.6f;  // to which colours are brought

/// A colour as it would be at a middling lightness: the light that falls on a surface changes from view to view, and
/// with it L, a and b together.
Eigen::Vector2f hueOf(const Eigen::Vector3f& color) {
  return middle_lightness / std::max(dark, color[0]) * color.tail<2>();
}

/// Squared difference in units of CIELab.
float squaredHueDifference(const Eigen::Vector2f& a, const Eigen::Vector2f& b) {
  return 120 * 120 * (a - b).squaredNorm();
}

/// A matched point with colour.
struct ColorMatch {
  Eigen::Vector2f color;         // of the point
  const CapturedView* into;      // the view in which it was matched
  const RangeImage::Cell* cell;  // in its image
};

/// Looks for the points of one view in what another camera saw.
void lookFor(const CapturedView& from, const CapturedView& into, const Eigen::Isometry3f& T,
             const VerificationSettings& settings, std::size_t stride, ViewAgreement& sum,
             std::vector<ColorMatch>& colors) {
  const float distance = float(settings.support_distance), agreement = float(std::cos(settings.support_angle));
  const bool colored = from.hasColor() && into.surface.hasColor() && settings.color_tolerance > 0;
  for (std::size_t i = 0; i < from.points.size(); i += stride) {
    const Eigen::Vector3f p = T * from.points.point(i), n = T.linear() * from.normals[i];
    const Eigen::Vector3f ray = into.surface.sensor_origin - p;
    sum.points += 1;
    const Sighting seen = into.image.look(p, distance);
    if (seen.sight == Sight::in_front) sum.in_front += 1;
    const bool may_be_lost = from.hasColor() && from.colors[i][0] < dark;
    if (seen.sight == Sight::unknown && !may_be_lost && into.silhouette.isOutside(p, distance)) sum.outside += 1;
    if (n.dot(ray) <= grazing * ray.norm()) continue;
    if (seen.sight != Sight::occluded) sum.facing += 1;
    const bool matched = seen.hasPoint() && n.dot(seen.cell->normal()) > agreement &&
                         (seen.cell->position() - p).squaredNorm() <= distance * distance;
    if (!matched) continue;
    sum.matched += 1;
    if (colored) colors.push_back({hueOf(from.colors[i]), &into, seen.cell});
  }
}

/// Calls `f(color)` for what a camera saw in a cell and in those around it: prints are displaced by as much.
template <typename Function>
void forEachColorAround(const CapturedView& view, const RangeImage::Cell* cell, Function&& f) {
  const int width = view.image.projection().width, height = view.image.projection().height;
  const int at = int(cell - view.image.cells().data()), column = at % width, row = at / width;
  for (int r = std::max(0, row - 1); r <= std::min(height - 1, row + 1); ++r) {
    for (int c = std::max(0, column - 1); c <= std::min(width - 1, column + 1); ++c) {
      const std::uint32_t point = view.image.pointAt(std::size_t(r) * std::size_t(width) + std::size_t(c));
      if (point != no_point) f(hueOf(view.surface.colorAt(point)));
    }
  }
}

/// By which the colours of view b differ from those of view a: the median over the matches.
Eigen::Vector2f commonShift(const std::vector<ColorMatch>& colors, const CapturedView& b) {
  std::vector<float> values(colors.size());
  Eigen::Vector2f shift;
  for (int axis = 0; axis < 2; ++axis) {
    for (std::size_t i = 0; i < colors.size(); ++i) {
      const ColorMatch& match = colors[i];
      const float seen = hueOf(match.into->surface.colorAt(match.into->image.pointOf({Sight::at, match.cell})))[axis];
      values[i] = match.into == &b ? seen - match.color[axis] : match.color[axis] - seen;
    }
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    shift[axis] = *middle;
  }
  return shift;
}

double colorsAgree(const std::vector<ColorMatch>& colors, const CapturedView& b, float tolerance) {
  if (colors.empty()) return 1;
  const Eigen::Vector2f shift = commonShift(colors, b);
  std::size_t agreeing = 0;
  for (const ColorMatch& match : colors) {
    const Eigen::Vector2f expected = match.color + (match.into == &b ? 1.0f : -1.0f) * shift;
    float difference = std::numeric_limits<float>::infinity();
    forEachColorAround(*match.into, match.cell, [&](const Eigen::Vector2f& seen) {
      difference = std::min(difference, squaredHueDifference(expected, seen));
    });
    agreeing += difference < tolerance * tolerance ? 1 : 0;
  }
  return double(agreeing) / double(colors.size());
}

}  // namespace

ViewAgreement compareViews(const CapturedView& a, const CapturedView& b, const Eigen::Isometry3d& T_b_a,
                           const VerificationSettings& settings, std::size_t stride) {
  ViewAgreement sum;
  thread_local std::vector<ColorMatch> colors;  // keeps its memory from pose to pose
  colors.clear();
  lookFor(a, b, T_b_a.cast<float>(), settings, stride, sum, colors);
  lookFor(b, a, T_b_a.inverse().cast<float>(), settings, stride, sum, colors);
  sum.color = colorsAgree(colors, b, float(settings.color_tolerance));
  sum.least = double(std::min(a.points.size(), b.points.size())) / double(stride);
  return sum;
}

}  // namespace sks
