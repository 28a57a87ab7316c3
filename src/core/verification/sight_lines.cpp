// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/sight_lines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/verification/color_agreement.hpp"
#include "core/verification/color_pattern.hpp"

namespace sks {
namespace {

constexpr double prior_rays = 1;         // keeps the fraction of few rays near 1
constexpr double prior_outline = 3;      // the same of the outline
constexpr float points_per_cell = 1.5f;  // edge of a cell in spacings of the model's points: few cells stay empty
constexpr int outside = 2;               // cells from the outline to where the scene is looked at, and
constexpr int clear = 3;                 // as many must be free of the model
constexpr double other_normal = 0.5;     // weight of a ray that met the scene where its normal differs
constexpr int widest_mask = 1024;        // along an edge of the mask

/// A point of the model where the pose puts it, and the ray to it.
struct RaySample {
  Eigen::Vector3f point, normal;
  float range = 0;
  int column = 0, row = 0;
  std::size_t index = 0;  // of the model's points
};

int floorOf(float value) {
  const int truncated = int(value);
  return truncated - (value < float(truncated) ? 1 : 0);
}

/// The model as the sensor would see it alone: the nearest of its points in each cell of a perspective grid.
class Silhouette {
public:
  Silhouette(const ModelSurface& model, const SceneView& scene, const Eigen::Isometry3f& T, float self_occlusion) {
    const RangeImage::Projection& image = scene.range_image.projection();
    const Eigen::Vector3f sensor = T.inverse() * image.origin;
    thread_local std::vector<RaySample> facing;  // these keep their memory from pose to pose
    thread_local std::vector<float> nearest;
    facing.clear();
    for (std::size_t i = 0; i < model.points.size(); ++i) {
      const Eigen::Vector3f to_sensor = sensor - model.points[i];
      const float range = to_sensor.norm();
      if (!(model.normals[i].dot(to_sensor) > grazing * range)) continue;
      RaySample placed;
      placed.point = T * model.points[i];
      const Eigen::Vector3f p = image.axes * (placed.point - image.origin);
      if (!(p.z() > RangeImage::rim * range)) continue;
      placed.normal = T.linear() * model.normals[i];
      placed.range = range;
      placed.index = i;
      if (facing.empty()) cell_ = points_per_cell * model.resolution / range;  // about the same for all
      placed.column = floorOf(p.x() / p.z() / cell_);
      placed.row = floorOf(p.y() / p.z() / cell_);
      facing.push_back(placed);
    }
    if (facing.empty()) return;
    int right = facing[0].column, bottom = facing[0].row;
    left_ = right, top_ = bottom;
    for (const RaySample& p : facing) {
      left_ = std::min(left_, p.column), right = std::max(right, p.column);
      top_ = std::min(top_, p.row), bottom = std::max(bottom, p.row);
    }
    width_ = right - left_ + 1, height_ = bottom - top_ + 1;
    if (width_ > widest_mask || height_ > widest_mask) {  // the sensor is inside of the object
      width_ = height_ = 0;
      return;
    }
    nearest.assign(std::size_t(width_) * std::size_t(height_), std::numeric_limits<float>::infinity());
    for (const RaySample& p : facing) {
      float& range = nearest[at(p.column, p.row)];
      range = std::min(range, p.range);
    }
    covered_.assign(nearest.size(), 0);
    visible_.reserve(facing.size());
    for (const RaySample& p : facing) {
      if (p.range > nearest[at(p.column, p.row)] + self_occlusion) continue;
      covered_[at(p.column, p.row)] = 1;
      visible_.push_back(p);
    }
  }

  const std::vector<RaySample>& visible() const { return visible_; }
  float cell() const { return cell_; }

  /// Whether the model ends at a point of it in a direction of the image.
  bool endsAt(const RaySample& p, int dx, int dy) const {
    for (int k = 1; k <= clear; ++k) {
      const int column = p.column + k * dx, row = p.row + k * dy;
      const bool within = column >= left_ && row >= top_ && column < left_ + width_ && row < top_ + height_;
      if (within && covered_[at(column, row)]) return false;
    }
    return true;
  }

private:
  std::size_t at(int column, int row) const {
    return std::size_t(row - top_) * std::size_t(width_) + std::size_t(column - left_);
  }

  float cell_ = 1;
  int left_ = 0, top_ = 0, width_ = 0, height_ = 0;
  std::vector<char> covered_;
  std::vector<RaySample> visible_;
};

/// Whether the surface that the scene has at the edge of the model goes on beyond it.
enum class Beyond { ends, goes_on, unmeasured, occluded };

Beyond beyondOutline(const RaySample& p, const RangeImage::Cell& inside, const Silhouette& silhouette, int dx, int dy,
                     const RangeImage& image, const VerificationSettings& settings) {
  const RangeImage::Projection& projection = image.projection();
  const Eigen::Vector3f q = projection.axes * (p.point - projection.origin);
  const float step = float(outside) * silhouette.cell();
  const Eigen::Vector3f direction(q.x() / q.z() + step * float(dx), q.y() / q.z() + step * float(dy), 1);
  const Eigen::Vector3f ray = projection.axes.transpose() * direction.normalized();
  const Sighting seen = image.look(projection.origin + p.range * ray, float(settings.occlusion_distance));
  if (!seen.hasPoint()) return Beyond::unmeasured;
  if ((seen.cell->position() - projection.origin).norm() < p.range - float(settings.occlusion_distance))
    return Beyond::occluded;
  const float apart = std::abs(inside.normal().dot(seen.cell->position() - inside.position()));
  const bool smooth = apart < 0.5f * float(settings.support_distance) &&
                      inside.normal().dot(seen.cell->normal()) > float(std::cos(settings.support_angle));
  return smooth ? Beyond::goes_on : Beyond::ends;
}

Eigen::Vector3f medianOf(std::vector<Eigen::Vector3f>& values) {
  Eigen::Vector3f median;
  for (int axis = 0; axis < 3; ++axis) {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end(),
                     [axis](const Eigen::Vector3f& a, const Eigen::Vector3f& b) { return a[axis] < b[axis]; });
    median[axis] = (*middle)[axis];
  }
  return median;
}

}  // namespace

double SightLines::agreement() const {
  const double rays = (confirmed + prior_rays) / (confirmed + missed + prior_rays);
  const double outline = (ends + prior_outline) / (ends + goes_on + prior_outline);
  return rays * outline * outline;
}

SightLines lookAlongRays(const ModelSurface& model, const SceneView& scene, const VerificationSettings& settings,
                         const Eigen::Isometry3d& T_scene_model, float object_size) {
  SightLines lines;
  const float distance = float(settings.support_distance), occlusion = float(settings.occlusion_distance);
  const float agreement = float(std::cos(settings.support_angle));
  const Silhouette silhouette(model, scene, T_scene_model.cast<float>(), occlusion);
  const bool colored = scene.color_tolerance > 0 && !model.colors.empty();
  std::vector<Eigen::Vector3f> differences;
  ColorPattern pattern;
  for (const RaySample& p : silhouette.visible()) {
    const Sighting seen = scene.range_image.look(p.point, occlusion);
    const bool confirmed = seen.hasPoint() && p.normal.dot(seen.cell->normal()) > agreement &&
                           (seen.cell->position() - p.point).squaredNorm() <= distance * distance;
    if (!confirmed) {
      if (seen.sight == Sight::unknown) lines.missed += unmeasured;
      if (seen.sight == Sight::at || seen.sight == Sight::in_front) lines.missed += 1;
      continue;
    }
    if (scene.onLargerPlane(scene.range_image.pointOf(seen), object_size)) continue;
    lines.confirmed += 1;
    if (colored) {
      const Eigen::Vector3f &color = model.colors[p.index],
                            seen_color = scene.surface.colorAt(scene.range_image.pointOf(seen));
      differences.push_back(seen_color - color);
      pattern.add(color, seen_color);
    }
    constexpr int directions[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    for (const auto& [dx, dy] : directions) {
      if (!silhouette.endsAt(p, dx, dy)) continue;
      const Beyond beyond = beyondOutline(p, *seen.cell, silhouette, dx, dy, scene.range_image, settings);
      if (beyond == Beyond::ends) lines.ends += 1;
      if (beyond == Beyond::unmeasured) lines.ends += unmeasured;
      if (beyond == Beyond::goes_on) lines.goes_on += 1;
    }
  }
  if (!differences.empty()) {
    lines.color_shift = medianOf(differences);
    lines.pattern = pattern.agreement(double(scene.color_tolerance));
  }
  return lines;
}

RayAgreement agreementAlongRays(const ModelSurface& model, const SceneView& scene, const VerificationSettings& settings,
                                const Eigen::Isometry3d& T_scene_model, float object_size) {
  RayAgreement all;
  const float distance = float(settings.support_distance), occlusion = float(settings.occlusion_distance);
  const float agreement = float(std::cos(settings.support_angle));
  const Silhouette silhouette(model, scene, T_scene_model.cast<float>(), occlusion);
  const bool colored = scene.color_tolerance > 0 && !model.colors.empty();
  ColorPattern pattern;
  for (const RaySample& p : silhouette.visible()) {
    const Sighting seen = scene.range_image.look(p.point, occlusion);
    if (!seen.hasPoint() || (seen.cell->position() - p.point).squaredNorm() > distance * distance) {
      if (seen.sight == Sight::unknown) all.rays += unmeasured;
      if (seen.sight == Sight::at || seen.sight == Sight::in_front) all.rays += 1;
      continue;
    }
    const std::uint32_t point = scene.range_image.pointOf(seen);
    if (scene.onLargerPlane(point, object_size)) continue;
    all.rays += 1;
    all.met += 1;
    double agrees = p.normal.dot(seen.cell->normal()) > agreement ? 1 : other_normal;
    if (colored) {
      const Eigen::Vector3f &color = model.colors[p.index], seen_color = scene.colorAt(point);
      agrees *= double(colorAgreement(squaredColorDifference(color, seen_color), scene.color_tolerance));
      pattern.add(color, seen_color);
    }
    all.agreeing += agrees;
  }
  if (colored && all.met > 0) all.pattern = pattern.agreement(double(scene.color_tolerance));
  return all;
}

}  // namespace sks
