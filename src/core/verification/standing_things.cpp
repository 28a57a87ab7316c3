// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/standing_things.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "core/surface/clusters.hpp"
#include "core/surface/plane_ransac.hpp"

namespace sks {
namespace {

constexpr float patch_edge = 0.01f;        // [m] heights are averaged over a patch, the scale of the normals
constexpr int fewest_of_patch = 4;         // points
constexpr float near_plane = 0.015f;       // [m] what of a patch may be the plane, its noise, or a flat thing
constexpr float lowest_rise = 0.003f;      // [m] of a patch above its plane, and
constexpr float sure_deviations = 3.0f;    // ... in standard deviations of the patches of a plane
constexpr float foot = 0.4f;               // of a thing's height; what is lower beside it is the plane's noise
constexpr float gap = 0.015f;              // [m] things nearer to each other than this are one
constexpr float noise_at_edges = 0.01f;    // [m] measured larger than it is
constexpr float reach = 0.03f;             // [m] what begins higher above the plane does not stand on it
constexpr std::size_t fewest_points = 12;  // of a thing, thinned to half of the gap
constexpr std::size_t most_things = 40, most_parts = 60;
constexpr std::size_t most_of_pile = 4000;  // points; what has more is no pile

/// Row and column of a patch: whole numbers, which integers need not hold.
using PatchCell = std::pair<float, float>;

/// A plane with axes of its own.
struct Frame {
  Frame(const Eigen::Vector3f& normal, float offset) : up(normal), floor(offset) {
    u = normal.unitOrthogonal();
    v = normal.cross(u);
  }

  float heightOf(const Eigen::Vector3f& p) const { return up.dot(p) - floor; }
  PatchCell patchOf(const Eigen::Vector3f& p) const {
    return {std::floor(u.dot(p) / patch_edge), std::floor(v.dot(p) / patch_edge)};
  }

  Eigen::Vector3f up, u, v;
  float floor;
};

/// The large plane, fitted to all of its points.
Frame fittedFrame(const Surface& scene, const LargePlane& plane) {
  std::vector<Eigen::Vector3f> members;
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const Eigen::Vector3f p = scene.point(i);
    if (plane.contains(p, scene.normal(i))) members.push_back(p);
  }
  const PlaneFit fit = leastSquaresPlane(members);
  Eigen::Vector3f normal = fit.normal.cast<float>();
  if (normal.dot(plane.normal) < 0) normal = -normal;
  return {normal, normal.dot(fit.mean.cast<float>())};
}

struct Patch {
  PatchCell cell;
  float sum = 0;
  int count = 0;

  float height() const { return sum / float(count); }
};

/// Patches of points at a plane, by cell.
std::vector<Patch> patchesAt(const Surface& scene, const Frame& frame) {
  std::vector<Patch> runs;  // of consecutive points: they lie side by side
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const float height = frame.heightOf(scene.point(i));
    if (!(std::abs(height) < near_plane)) continue;
    const PatchCell cell = frame.patchOf(scene.point(i));
    if (runs.empty() || runs.back().cell != cell) runs.push_back({cell, 0, 0});
    runs.back().sum += height;
    ++runs.back().count;
  }
  std::stable_sort(runs.begin(), runs.end(), [](const Patch& a, const Patch& b) { return a.cell < b.cell; });
  std::vector<Patch> patches;
  for (const Patch& run : runs) {
    if (patches.empty() || patches.back().cell != run.cell) patches.push_back({run.cell, 0, 0});
    patches.back().sum += run.sum;
    patches.back().count += run.count;
  }
  patches.erase(
      std::remove_if(patches.begin(), patches.end(), [](const Patch& p) { return p.count < fewest_of_patch; }),
      patches.end());
  return patches;
}

float medianOfHeights(std::vector<float> values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Heights from which patches rise above the plane: of its own unevenness, and where it lies in the median.
std::pair<float, float> baseAndRise(const std::vector<Patch>& patches) {
  std::vector<float> heights;
  for (const Patch& patch : patches) heights.push_back(patch.height());
  const float base = medianOfHeights(heights);
  for (float& height : heights) height = std::abs(height - base);
  return {base, std::max(lowest_rise, sure_deviations * 1.4826f * medianOfHeights(heights))};
}

/// The height from which a point of a patch belongs to what raises it, and not to the plane beside it: a fraction of
/// the highest patch around. @param raised patches, by cell
float lowestOfThing(const std::vector<std::pair<PatchCell, float>>& raised, const PatchCell& cell, float rise) {
  const auto heightAt = [&](const PatchCell& c) {
    const auto found = std::lower_bound(raised.begin(), raised.end(), std::make_pair(c, 0.0f));
    return found != raised.end() && found->first == c ? found->second : 0.0f;
  };
  if (heightAt(cell) <= 0) return std::numeric_limits<float>::infinity();
  float highest = 0;
  for (int dx = -1; dx <= 1; ++dx) {
    for (int dy = -1; dy <= 1; ++dy) {
      highest = std::max(highest, heightAt({cell.first + float(dx), cell.second + float(dy)}));
    }
  }
  return std::max(0.5f * rise, foot * highest);
}

/// Scene points that rise above the plane: those of patches that do, and all that are higher.
std::vector<std::uint32_t> risingPoints(const Surface& scene, const Frame& frame, float largest) {
  const std::vector<Patch> patches = patchesAt(scene, frame);
  if (patches.empty()) return {};
  const auto [base, rise] = baseAndRise(patches);
  std::vector<std::pair<PatchCell, float>> raised;
  for (const Patch& patch : patches) {
    if (patch.height() - base > rise) raised.push_back({patch.cell, patch.height() - base});
  }
  std::vector<std::uint32_t> rising;
  for (std::uint32_t i = 0; i < scene.size(); ++i) {
    const float height = frame.heightOf(scene.point(i)) - base;
    if (height > largest + noise_at_edges || height < 0.5f * rise) continue;
    const bool above = height > near_plane || height > lowestOfThing(raised, frame.patchOf(scene.point(i)), rise);
    if (above) rising.push_back(i);
  }
  return rising;
}

/// @param points of a connected group, at least one
StandingThing describedThing(const std::vector<Eigen::Vector3f>& points, const Frame& frame) {
  StandingThing thing;
  thing.up = frame.up, thing.floor = frame.floor;
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const Eigen::Vector3f& p : points) {
    sum += p;
    thing.height = std::max(thing.height, frame.heightOf(p));
  }
  thing.centroid = sum / float(points.size());
  thing.base = baseExtent(points, frame.up);
  return thing;
}

/// Things that touch each other, as they may.
struct Pile {
  OrientedPoints points;
  Eigen::Vector3f up = Eigen::Vector3f::UnitZ();
};

/// What stands on one plane.
struct OnePlane {
  std::vector<StandingThing> things;
  std::vector<Pile> piles;
  std::vector<std::uint32_t> rises;  // scene points so near the plane that they could be taken for it
};

OnePlane standingOn(const LargePlane& plane, const Surface& scene, float largest) {
  OnePlane standing;
  const Frame frame = fittedFrame(scene, plane);
  std::vector<Eigen::Vector3f> points;
  const std::vector<std::uint32_t> rising = risingPoints(scene, frame, largest);
  for (const std::uint32_t i : rising) {
    if (frame.heightOf(scene.point(i)) < near_plane) standing.rises.push_back(i);
    points.push_back(scene.point(i));
  }
  if (points.empty()) return standing;
  const PointGrid grid(points, gap);
  std::vector<Eigen::Vector3f> thinned, normals;
  for (const std::uint32_t i : thinnedIndices(grid, 0.5 * double(gap))) {
    thinned.push_back(grid.point(i));
    normals.push_back(scene.normal(rising[grid.source[i]]));
  }
  for (const Indices& cluster : findClusters(thinned, gap)) {
    if (cluster.size() < fewest_points || standing.things.size() >= most_things) break;
    const std::vector<Eigen::Vector3f> members = at(thinned, cluster);
    const bool stands = std::any_of(members.begin(), members.end(),
                                    [&](const Eigen::Vector3f& p) { return frame.heightOf(p) < reach; });
    const StandingThing thing = describedThing(members, frame);
    if (stands && thing.base.length <= largest + noise_at_edges) standing.things.push_back(thing);
    if (!stands || cluster.size() > most_of_pile) continue;
    OrientedPoints pile;
    for (const std::uint32_t i : cluster) pile.add(thinned[i], normals[i]);
    standing.piles.push_back({std::move(pile), frame.up});
  }
  return standing;
}

/// Of all piles, in their order.
std::vector<PilePart> partsOf(const std::vector<Pile>& piles, float stick_width, int threads) {
  std::vector<std::vector<PilePart>> of_piles(piles.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t i = 0; i < piles.size(); ++i) {
    of_piles[i] = pileParts(piles[i].points, 0.5f * gap, piles[i].up, stick_width);
  }
  std::vector<PilePart> all;
  for (const auto& parts : of_piles) all.insert(all.end(), parts.begin(), parts.end());
  return all;
}

}  // namespace

StandingThings findStandingThings(const Surface& scene, const std::vector<LargePlane>& planes, float largest,
                                  float stick_width, int threads) {
  std::vector<OnePlane> found(planes.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t p = 0; p < planes.size(); ++p) {
    const bool side_of_a_thing = planes[p].extent < largest;
    if (!side_of_a_thing) found[p] = standingOn(planes[p], scene, largest);
  }
  StandingThings standing;
  standing.rises.assign(scene.size(), 0);
  std::vector<Pile> piles;
  for (OnePlane& one : found) {
    for (const std::uint32_t i : one.rises) standing.rises[i] = 1;
    standing.things.insert(standing.things.end(), one.things.begin(), one.things.end());
    std::move(one.piles.begin(), one.piles.end(), std::back_inserter(piles));
  }
  standing.parts = partsOf(piles, stick_width, threads);
  if (standing.things.size() > most_things) standing.things.resize(most_things);
  if (standing.parts.size() > most_parts) standing.parts.resize(most_parts);
  return standing;
}

}  // namespace sks
