// SPDX-License-Identifier: BSD-3-Clause
#include "core/keypoints/sparse_selection.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/keypoints/local_curvature.hpp"
#include "core/keypoints/otsu.hpp"
#include "core/surface/plane_fit.hpp"

namespace sks {
namespace {

/// Spreads equal curvatures over the scene: a fixed one-to-one scramble of the index.
std::uint32_t scramble(std::uint32_t index) {
  index = (index ^ (index >> 16)) * 0x7feb352du;
  index = (index ^ (index >> 15)) * 0x846ca68bu;
  return index ^ (index >> 16);
}

std::vector<char> keepByRank(const std::vector<float>& curvature, double discard) {
  const std::size_t n = curvature.size();
  std::vector<std::uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  const std::size_t dropped = std::size_t(std::floor(discard * double(n) + 1e-9));
  std::nth_element(order.begin(), order.begin() + dropped, order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::make_pair(curvature[a], scramble(a)) < std::make_pair(curvature[b], scramble(b));
  });
  std::vector<char> keep(n, 1);
  for (std::size_t i = 0; i < dropped; ++i) keep[order[i]] = 0;
  return keep;
}

}  // namespace

void measureCurvature(const Surface& surface, Keypoints& keypoints, const KeypointSettings& settings,
                      const SurfaceSettings& surface_settings, int threads) {
  const std::size_t n = keypoints.size();
  keypoints.normals.resize(n);
  keypoints.curvature.assign(n, 0.0f);
  const float normal_radius = float(surface_settings.normal_radius), local_radius = float(settings.grid_size);
  constexpr std::size_t chunk = 64;
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::size_t begin = 0; begin < n; begin += chunk) {
    const std::size_t end = std::min(begin + chunk, n);
    thread_local std::vector<PointGrid::Run> runs;  // kept from frame to frame
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3f& position = keypoints.positions[i];
      surface.findRuns(position, normal_radius, runs);
      keypoints.normals[i] = fitPlane(surface, position, normal_radius, surface_settings.normal_min_neighbors, runs);
      if (!keypoints.normals[i].allFinite()) continue;
      surface.findRuns(position, local_radius, runs);
      keypoints.curvature[i] = gaussianCurvature(surface, position, keypoints.normals[i], local_radius, runs);
    }
  }
}

Keypoints selectKeypoints(const Keypoints& keypoints, const KeypointSettings& settings) {
  std::vector<char> keep;
  if (settings.selection == SelectionRule::rank) {
    keep = keepByRank(keypoints.curvature, settings.discard);
  } else {
    const double threshold = settings.selection == SelectionRule::threshold ? settings.curvature_threshold
                                                                            : otsuThreshold(keypoints.curvature);
    for (const float k : keypoints.curvature) keep.push_back(k >= threshold);
  }
  Keypoints selected;
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    if (!keep[i]) continue;
    selected.positions.push_back(keypoints.positions[i]);
    selected.normals.push_back(keypoints.normals[i]);
    selected.curvature.push_back(keypoints.curvature[i]);
  }
  return selected;
}

}  // namespace sks
