// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/pile_parts.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include <sks_detector/stages/point_grid.hpp>

#include "core/surface/clusters.hpp"

namespace sks {
namespace {

// [m] less than half of a card's height: the card on it is another face. 25 degrees: normals bend at edges.
constexpr PlaneTolerance face_tolerance{0.0025f, 0.9f};
constexpr std::size_t most_faces = 12, most_sticks = 12;
constexpr std::size_t fewest_of_part = 12;  // points, of a face or a stick
constexpr float step_in_face = 2;           // spacings between its points
// Necks: points with most of the neighbours that a point within a face has are its cores.
constexpr float neck = 3;  // spacings
constexpr float inner_share = 0.85f, full_rank = 0.9f;
constexpr std::size_t fewest_of_core = 4;
constexpr float step_in_core = 1.6f;  // spacings
// Sticks
constexpr int line_trials = 500, most_picks = 16;  // ... of a second point
constexpr float noise_beside = 0.003f;             // [m]
constexpr float step_in_stick = 3;                 // spacings without a point end it
constexpr float shortest_stick = 5;                // length over width
constexpr float least_filled = 0.5f;               // of a row of points along it
constexpr float most_beside = 0.25f;               // of its points, on both sides of it

using Positions = std::vector<Eigen::Vector3f>;

PilePart partOf(const Positions& points, const Eigen::Vector3f& up, bool stick) {
  PilePart part;
  part.up = up, part.stick = stick;
  for (const Eigen::Vector3f& p : points) part.centroid += p / float(points.size());
  part.base = baseExtent(points, up);
  return part;
}

OrientedPoints withoutTaken(const OrientedPoints& points, const Indices& taken) {
  std::vector<char> gone(points.size(), 0);
  for (const std::uint32_t i : taken) gone[i] = 1;
  OrientedPoints left;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!gone[i]) left.add(points.point(i), points.normal(i));
  }
  return left;
}

Positions allPositions(const OrientedPoints& points) {
  Positions all;
  for (std::size_t i = 0; i < points.size(); ++i) all.push_back(points.point(i));
  return all;
}

/// Points of a face that lie far from its edge.
Positions innerPoints(const Positions& face, float radius) {
  const PointGrid grid(face, radius);
  std::vector<PointGrid::Run> runs;
  std::vector<int> neighbors(face.size(), 0);
  for (std::size_t i = 0; i < face.size(); ++i) {
    grid.forEachNeighbor(face[i], radius, runs, [&](std::uint32_t, float) { ++neighbors[i]; });
  }
  std::vector<int> sorted = neighbors;
  const auto rank = sorted.begin() + std::ptrdiff_t(full_rank * float(sorted.size()));
  std::nth_element(sorted.begin(), rank, sorted.end());
  Positions inner;
  for (std::size_t i = 0; i < face.size(); ++i) {
    if (float(neighbors[i]) > inner_share * float(*rank)) inner.push_back(face[i]);
  }
  return inner;
}

/// The pieces of a face that hang together by narrow necks only; none if there are no necks.
std::vector<Positions> cutAtNecks(const Positions& face, float spacing) {
  const float radius = neck * spacing;
  const Positions inner = innerPoints(face, radius);
  if (inner.empty()) return {};
  std::vector<Positions> cores;
  for (const Indices& cluster : findClusters(inner, double(step_in_core * spacing))) {
    if (cluster.size() >= fewest_of_core) cores.push_back(at(inner, cluster));
  }
  if (cores.size() < 2) return {};
  std::vector<Positions> pieces(cores.size());
  for (const Eigen::Vector3f& p : face) {
    float nearest = 2 * radius * radius;
    Positions* piece = nullptr;
    for (std::size_t c = 0; c < cores.size(); ++c) {
      for (const Eigen::Vector3f& q : cores[c]) {
        const float squared = (p - q).squaredNorm();
        if (squared < nearest) nearest = squared, piece = &pieces[c];
      }
    }
    if (piece != nullptr) piece->push_back(p);
  }
  return pieces;
}

struct Stick {
  Indices members;
  Eigen::Vector3f axis = Eigen::Vector3f::UnitX();
};

struct Line {
  Eigen::Vector3f origin, axis;
};

/// Where points lie beside a line.
struct AlongLine {
  std::vector<float> position;  ///< along it [m]
  std::vector<float> squared;   ///< distances from it [m^2]
};

/// Without branches, so that the compiler takes several at once.
void placeAlong(const OrientedPoints& points, const Line& line, AlongLine& along) {
  const float *x = points.x.data(), *y = points.y.data(), *z = points.z.data();
  const Eigen::Vector3f o = line.origin, n = line.axis;
  const std::size_t size = points.size();
  along.position.resize(size), along.squared.resize(size);
  float *position = along.position.data(), *squared = along.squared.data();
  for (std::size_t i = 0; i < size; ++i) {
    const float dx = x[i] - o.x(), dy = y[i] - o.y(), dz = z[i] - o.z();
    const float t = dx * n.x() + dy * n.y() + dz * n.z();
    position[i] = t;
    squared[i] = dx * dx + dy * dy + dz * dz - t * t;
  }
}

/// The longest run of points along a line, if there is little beside it.
Stick stickAlong(const OrientedPoints& points, const Eigen::Vector3f& up, const Line& line, float radius, float spacing,
                 AlongLine& buffer) {
  placeAlong(points, line, buffer);
  const std::vector<float>&position = buffer.position, &squared = buffer.squared;
  const float limit = radius * radius;
  std::vector<std::pair<float, std::uint32_t>> along;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (squared[i] < limit) along.push_back({position[i], i});
  }
  std::sort(along.begin(), along.end());
  std::size_t longest = 0, size = 0, first = 0;
  for (std::size_t i = 0; i < along.size(); ++i) {
    if (i > first && along[i].first - along[i - 1].first > step_in_stick * spacing) first = i;
    if (i + 1 - first > size) longest = first, size = i + 1 - first;
  }
  if (size < fewest_of_part) return {};
  const float begin = along[longest].first, end = along[longest + size - 1].first;
  if (end - begin < 2 * radius * shortest_stick || float(size) * spacing < least_filled * (end - begin)) return {};
  std::size_t beside = 0;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const bool near = position[i] > begin && position[i] < end && squared[i] >= limit && squared[i] < 4 * limit;
    if (!near) continue;
    const bool below = (points.point(i) - line.origin).dot(up) < -0.5f * radius;  // it lies on that
    if (!below) ++beside;
  }
  if (float(beside) > most_beside * float(size)) return {};
  Stick stick;
  stick.axis = line.axis;
  for (std::size_t i = longest; i < longest + size; ++i) stick.members.push_back(along[i].second);
  return stick;
}

/// Lines through two random points, at least the shortest stick's length apart but no more than twice that.
std::vector<Line> randomLines(const Positions& points, float apart, std::mt19937& random) {
  std::vector<Line> lines;
  for (int trial = 0; trial < line_trials; ++trial) {
    const Eigen::Vector3f& a = points[random() % points.size()];
    for (int pick = 0; pick < most_picks; ++pick) {
      const Eigen::Vector3f to_b = points[random() % points.size()] - a;
      if (to_b.squaredNorm() <= apart * apart || to_b.squaredNorm() >= 4 * apart * apart) continue;
      lines.push_back({a, to_b.normalized()});
      break;
    }
  }
  return lines;
}

/// How many points are near to a line.
std::size_t countAlong(const OrientedPoints& points, const Line& line, float radius, AlongLine& buffer) {
  placeAlong(points, line, buffer);
  const float limit = radius * radius;
  return std::size_t(std::count_if(buffer.squared.begin(), buffer.squared.end(), [&](float s) { return s < limit; }));
}

/// RANSAC: of random lines the one with the longest run of points.
Stick mostSupportedStick(const OrientedPoints& points, const Positions& positions, const Eigen::Vector3f& up,
                         float radius, float spacing, std::mt19937& random) {
  AlongLine buffer;
  std::vector<std::pair<std::size_t, Line>> lines;  // and the points along each
  for (const Line& line : randomLines(positions, radius * shortest_stick, random)) {
    lines.emplace_back(countAlong(points, line, radius, buffer), line);
  }
  std::stable_sort(lines.begin(), lines.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  Stick best;
  for (const auto& [count, line] : lines) {
    if (count < fewest_of_part || count <= best.members.size()) break;
    Stick stick = stickAlong(points, up, line, radius, spacing, buffer);
    if (stick.members.size() > best.members.size()) best = std::move(stick);
  }
  return best;
}

/// Takes the sticks out of the points.
std::vector<PilePart> takeSticks(OrientedPoints& points, float spacing, const Eigen::Vector3f& up, float width,
                                 std::mt19937& random) {
  constexpr float lying = 0.3f;  // sine of the angle between stick and `up`
  std::vector<PilePart> sticks;
  while (points.size() >= fewest_of_part && sticks.size() < most_sticks) {
    const Positions positions = allPositions(points);
    const Stick stick = mostSupportedStick(points, positions, up, 0.5f * width + noise_beside, spacing, random);
    if (stick.members.empty()) break;
    const Eigen::Vector3f across = up - up.dot(stick.axis) * stick.axis;
    if (across.norm() > lying) sticks.push_back(partOf(at(positions, stick.members), across.normalized(), true));
    points = withoutTaken(points, stick.members);
  }
  return sticks;
}

}  // namespace

std::vector<PilePart> pileParts(const OrientedPoints& points, float spacing, const Eigen::Vector3f& up,
                                float stick_width) {
  std::mt19937 random(1);
  OrientedPoints rest = points;
  std::vector<PilePart> parts;
  if (stick_width > 0) parts = takeSticks(rest, spacing, up, stick_width, random);
  for (std::size_t k = 0; k < most_faces && rest.size() >= fewest_of_part; ++k) {
    const SupportedPlane plane = mostSupportedPlane(rest, face_tolerance, fewest_of_part, random, 1);
    if (plane.members.size() < fewest_of_part) break;
    const Positions members = at(allPositions(rest), plane.members);
    for (const Indices& cluster : findClusters(members, double(step_in_face * spacing))) {
      if (cluster.size() < fewest_of_part) break;
      const Positions face = at(members, cluster);
      parts.push_back(partOf(face, plane.plane.normal, false));
      for (const Positions& piece : cutAtNecks(face, spacing)) {
        if (piece.size() >= fewest_of_part) parts.push_back(partOf(piece, plane.plane.normal, false));
      }
    }
    rest = withoutTaken(rest, plane.members);
  }
  return parts;
}

}  // namespace sks
