// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/captured_view.hpp"

#include <cmath>
#include <utility>

#include "core/registration/view_print.hpp"

namespace sks {
namespace {

constexpr double row_edge = 0.008;             // [m] about the distance within which partners are looked for
constexpr double points_per_resolution = 1.7;  // alignment wants denser points than the stored surface has

}  // namespace

CapturedView::CapturedView(Surface all, const Keypoints& detected, const Descriptors& described,
                           const Settings& settings, std::optional<Eigen::Hyperplane<double, 3>> support)
    : surface(std::move(all)),
      spacing(float(settings.training.surface_resolution / points_per_resolution)),
      descriptors(described.values),
      matcher(std::make_shared<const Matcher>(described.values, SearchKind::exact)),
      image(surface, float(settings.surface.normal_radius)),
      silhouette(image),
      plane(std::move(support)) {
  prints = printsOf(surface);
  for (std::size_t row = 0; row < described.keypoints.size(); ++row) {
    keypoints.push_back(detected.positions[described.keypoints[row]]);
    frames.push_back(described.frames[row]);
  }
  std::vector<Eigen::Vector3f> positions;
  std::vector<std::uint32_t> sources;
  for (const std::uint32_t i : thinnedIndices(surface, double(spacing))) {
    if (!surface.normal(i).allFinite()) continue;
    positions.push_back(surface.point(i));
    sources.push_back(i);
    center += positions.back().cast<double>();
  }
  center /= double(std::max<std::size_t>(1, positions.size()));
  double squares = 0;
  for (const Eigen::Vector3f& p : positions) squares += (p.cast<double>() - center).squaredNorm();
  radius = std::sqrt(squares / double(std::max<std::size_t>(1, positions.size())));
  points = PointGrid(positions, row_edge);
  for (const std::uint32_t i : points.source) {
    surface_point.push_back(sources[i]);
    normals.push_back(surface.normal(sources[i]));
    if (surface.hasColor()) colors.push_back(surface.colorAt(sources[i]));
  }
}

}  // namespace sks
